#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace burin::node {

/// Per cell of a grid (x fastest) the chessboard distance to the nearest `marked` cell (not 0), 0
/// for those that are; at most kLargestDistance, which also stands where there is none.
std::vector<std::uint8_t> chessboardDistance(std::span<const std::uint8_t> marked,
                                             const glm::ivec3& size);

inline constexpr int kLargestDistance = 63;

}  // namespace burin::node
