#include "visible_blocks.hpp"

#include <algorithm>

#include "burin/common/error.hpp"
#include "dilated_marks.hpp"
#include "extinction_means.hpp"

namespace burin::node {

VisibleBlocks::VisibleBlocks(const VolumeSurvey& survey, const ValueScale& scale)
    : ranges_{survey.blocks.blocks}, blockCells_{survey.blocks.blockCells} {
  const BlockRanges& blocks = survey.blocks;
  // As the textures' values up to a float's rounding, which VisibleValues allows for.
  const auto stored = [&](float value) {
    return static_cast<float>(std::clamp(scale.stored(double{value}), 0.0, 1.0));
  };
  for (std::size_t i = 0; i < blocks.lowest.size(); ++i) {
    if (survey.infiniteCount > 0) {
      ranges_.lowest[i] = 0;
      ranges_.highest[i] = 1;
    } else if (blocks.lowest[i] <= blocks.highest[i]) {
      ranges_.lowest[i] = stored(blocks.lowest[i]);
      ranges_.highest[i] = stored(blocks.highest[i]);
    }
  }
}

std::vector<std::uint8_t> VisibleBlocks::mark(const VisibleValues& visible,
                                              std::span<const glm::vec4> clipPlanes,
                                              const VolumeGrid& grid) const {
  std::vector<std::uint8_t> marks =
      ranges_.mark([&](float lowest, float highest) { return visible.any(lowest, highest); });
  dilateMarks(marks, ranges_.size, visible.reach(blockCells_));
  clearClipped(marks, cubes(), clipPlanes, grid);
  return marks;
}

std::vector<float> VisibleBlocks::extinction(const Scene& scene, const ValueScale& scale,
                                             std::span<const std::uint8_t> marks) const {
  const ExtinctionMeans means{scene, scale};
  std::vector<float> extinction(marks.size());
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) extinction[i] = means(ranges_.lowest[i], ranges_.highest[i]);
  return extinction;
}

IndexBox visiblePart(const IndexBox& cells, std::span<const std::uint8_t> marks,
                     const CubeGrid& cubes, int reach) {
  BURIN_CHECK_EQ(marks.size(), (IndexBox{glm::ivec3{0}, cubes.size}.count()));
  reach += 1;  // a look-up may round across a face
  const IndexBox reached{cells.lo - reach, cells.hi + reach};
  const glm::ivec3 first = glm::max(reached.lo - cubes.origin, glm::ivec3{0}) / cubes.cubeCells;
  const glm::ivec3 last =
      glm::min((reached.hi - cubes.origin - 1) / cubes.cubeCells, cubes.size - 1);
  glm::ivec3 lo = cubes.size;
  glm::ivec3 hi{0};
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(cubes.size.y) +
                         static_cast<std::size_t>(y);
        if (marks[row * static_cast<std::size_t>(cubes.size.x) + static_cast<std::size_t>(x)] == 0)
          continue;
        lo = glm::min(lo, glm::ivec3{x, y, z});
        hi = glm::max(hi, glm::ivec3{x, y, z} + 1);
      }
  if (hi.x <= lo.x) return {};
  const IndexBox marked = intersection(
      {cubes.origin + cubes.cubeCells * lo, cubes.origin + cubes.cubeCells * hi}, reached);
  return intersection({marked.lo - reach, marked.hi + reach}, cells);
}

}  // namespace burin::node
