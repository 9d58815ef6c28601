#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace burin::node {

/// Per cell of a grid (x fastest) the signed chessboard distance to the nearest cell of the other
/// kind: positive for cells that are not `marked`, negative for those that are; at most
/// kLargestDistance either way, which also stands where there is no cell of the other kind.
std::vector<std::int8_t> signedChessboardDistance(std::span<const std::uint8_t> marked,
                                                  const glm::ivec3& size);

inline constexpr int kLargestDistance = 63;

}  // namespace burin::node
