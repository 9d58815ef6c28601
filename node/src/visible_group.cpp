#include "visible_group.hpp"

#include <algorithm>
#include <array>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// The union of every set with those of up to `distance` cubes around it, along one axis at a time.
std::vector<LabelSet> spread(std::vector<LabelSet> sets, const glm::ivec3& size, int distance) {
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(size.x),
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t step = stride[static_cast<std::size_t>(axis)];
    for (int round = 0; round < distance; ++round) {
      const std::vector<LabelSet> before = sets;
      for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto at = static_cast<int>(i / step % static_cast<std::size_t>(size[axis]));
        if (at > 0) sets[i] |= before[i - step];
        if (at + 1 < size[axis]) sets[i] |= before[i + step];
      }
    }
  }
  return sets;
}

/// The scene with the layers of one mask (-1: those that are everywhere) alone.
Scene withLayersOf(const Scene& scene, const LabelMasks& masks, int mask) {
  Scene part = scene;
  part.layers.clear();
  for (const Layer& layer : scene.layers)
    if (masks.of(layer) == mask) part.layers.push_back(layer);
  return part;
}

}  // namespace

std::vector<VisibleGroup> visibleGroups(const Scene& scene, const LabelMasks& masks,
                                        const ValueScale& scale) {
  std::vector<VisibleGroup> groups;
  for (int mask = -1; mask < static_cast<int>(masks.sets().size()); ++mask) {
    const Scene part = withLayersOf(scene, masks, mask);
    if (part.layers.empty()) continue;
    VisibleGroup& group = groups.emplace_back();
    group.values = VisibleValues{part, transferTables(part, scale), scale};
    if (mask < 0) continue;
    group.mask = mask;
    for (const int label : masks.sets()[static_cast<std::size_t>(mask)])
      group.labels |= labelSet(label);
  }
  return groups;
}

std::vector<std::uint8_t> markBlocks(const VisibleBlocks& blocks,
                                     std::span<const VisibleGroup> groups,
                                     std::span<const LabelSet> labels, int reach,
                                     std::span<const glm::vec4> clipPlanes,
                                     const VolumeGrid& grid) {
  const CubeGrid cubes = blocks.cubes();
  std::vector<std::uint8_t> marks(IndexBox{glm::ivec3{0}, cubes.size}.count());
  std::vector<LabelSet> near;
  if (std::ranges::any_of(groups,
                          [](const VisibleGroup& group) { return group.mask.has_value(); })) {
    BURIN_CHECK_EQ(labels.size(), marks.size());
    const int distance = (reach + cubes.cubeCells - 1) / cubes.cubeCells;
    near = spread({labels.begin(), labels.end()}, cubes.size, distance);
  }
  for (const VisibleGroup& group : groups) {
    const std::vector<std::uint8_t> part = blocks.mark(group.values, clipPlanes, grid);
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (part[i] != 0 && (!group.mask || (near[i] & group.labels) != 0)) marks[i] = 1;
  }
  return marks;
}

}  // namespace burin::node
