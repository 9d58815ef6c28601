#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/node/survey.hpp"
#include "clip_planes.hpp"
#include "value_ranges.hpp"
#include "value_scale.hpp"
#include "visible_values.hpp"

namespace burin::node {

/// The survey's blocks in stored values: what a scene may show, known on every rank before any
/// voxel is loaded.
class VisibleBlocks {
 public:
  VisibleBlocks() = default;
  /// `scale`: the volume's, of the same survey. Infinite voxels count as either end of the values
  /// and may be anywhere, so with any of them every block may hold every value.
  VisibleBlocks(const VolumeSurvey& survey, const ValueScale& scale);

  CubeGrid cubes() const { return {glm::ivec3{0}, ranges_.size, blockCells_}; }

  std::size_t bytes() const { return ranges_.bytes(); }

  /// Per block 1 if its values may show something, x fastest.
  std::vector<std::uint8_t> mark(const VisibleValues& visible,
                                 std::span<const glm::vec4> clipPlanes,
                                 const VolumeGrid& grid) const;

  /// Per block the mean extinction over its range of values, per world unit, as if each were as
  /// frequent as any other; 0 where not marked. `marks`: of mark(), by the same scene.
  std::vector<float> extinction(const Scene& scene, const ValueScale& scale,
                                std::span<const std::uint8_t> marks) const;

 private:
  ValueRanges ranges_;
  int blockCells_ = 1;
};

/// The smallest box of cells outside of which no segment with its middle in `cells` meets a marked
/// cube, segments reaching up to `reach` voxels from their middle and, for look-ups that round, one
/// cell further; empty if none does. `marks`: one per cube.
IndexBox visiblePart(const IndexBox& cells, std::span<const std::uint8_t> marks,
                     const CubeGrid& cubes, int reach);

}  // namespace burin::node
