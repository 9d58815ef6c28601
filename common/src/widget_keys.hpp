#pragma once

#include <vector>

#include "burin/common/transfer_widget.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// "widgets" of a two-dimensional transfer function.
Codec<std::vector<TransferWidget>> widgetsCodec();

}  // namespace burin::scene_io
