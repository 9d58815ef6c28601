#pragma once

#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"

namespace burin::node {

/// How many of a view's rays meet a cell of each block, against a cell at the volume's centre: the
/// squared ratio of their depths (blocks nearer than their own radius count as being there), for a
/// parallel view 1, less at the image's borders, and 0 beside the image and behind a perspective
/// eye. x fastest.
std::vector<float> raysPerCell(const Camera& view, const CubeGrid& blocks, const VolumeGrid& grid);

}  // namespace burin::node
