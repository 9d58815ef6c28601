#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace burin::node {

/// Marks, 0 or 1 for every cube of a grid (x fastest), spread to all cubes no more than `reach`
/// away along every axis. reach 0 changes nothing.
void dilateMarks(std::vector<std::uint8_t>& marks, const glm::ivec3& size, int reach);

}  // namespace burin::node
