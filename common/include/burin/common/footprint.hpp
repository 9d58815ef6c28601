#pragma once

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"
#include "burin/common/image.hpp"

namespace burin {

/// Pixels whose rays can meet the box of cells: conservative (never too small), clipped to the
/// image; the whole image if part of the box lies beside or behind a perspective eye, empty if all
/// of it lies behind.
PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells);

}  // namespace burin
