#pragma once

#include "burin/common/image.hpp"
#include "burin/common/memory_check.hpp"

namespace burin::host {

/// What a picture takes at least, all of it on rank 0 (nothing on the others): the frame as merged,
/// as drawn there by OpenGL or in double, and as 8 bits or encoded floats. What other ranks draw
/// depends on the view.
MemoryNeed pictureNeed(const Communicator& comm, ImageSize size);

}  // namespace burin::host
