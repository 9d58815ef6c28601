#pragma once

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"
#include "burin/common/image.hpp"

namespace burin {

/// Pixels whose rays can meet the box of cells: conservative (never too small), clipped to the
/// image; the whole image if part of the box lies beside or behind a perspective eye, empty if all
/// of it lies behind.
PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells);

/// Depths along the view direction from the eye's plane, world units.
struct DepthRange {
  double nearest = 0;
  double farthest = 0;
};
/// Of the box of cells, which must not be empty.
DepthRange depthRange(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells);

/// The same of the part of the box at those depths, which may be nothing.
PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells,
                    const DepthRange& depths);

}  // namespace burin
