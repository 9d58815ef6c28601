#include "value_ranges.hpp"

#include <limits>

#include "burin/common/geometry.hpp"

namespace burin::node {
ValueRanges::ValueRanges(const glm::ivec3& cubes) : size{cubes} {
  const std::size_t count = IndexBox{glm::ivec3{0}, cubes}.count();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  lowest.assign(count, kInfinity);
  highest.assign(count, -kInfinity);
}

}  // namespace burin::node
