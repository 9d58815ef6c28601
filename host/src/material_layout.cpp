#include "material_layout.hpp"

namespace burin::host {

namespace {

/// Mean over blocks of the share of them that is high: 0, a half if both occur, or 1.
struct HighShare {
  double sum = 0;
  double blocks = 0;
  double mean() const { return blocks > 0 ? sum / blocks : 0; }
};

template <typename Visit>
void forBlocks(const node::BlockRanges& blocks, Visit&& visit) {
  for (int z = 0; z < blocks.blocks.z; ++z)
    for (int y = 0; y < blocks.blocks.y; ++y)
      for (int x = 0; x < blocks.blocks.x; ++x) visit(glm::ivec3{x, y, z});
}

}  // namespace

Surroundings findSurroundings(const node::BlockRanges& blocks, double boundary) {
  constexpr double kThinnest = 0.1;    // of all blocks, those that lie within
  constexpr double kAsFrequent = 0.9;  // at the faces, of within
  constexpr double kRare = 0.3;
  HighShare faces, within;
  forBlocks(blocks, [&](const glm::ivec3& block) {
    const std::size_t at = blocks.index(block);
    const double lowest = double{blocks.lowest[at]};
    const double highest = double{blocks.highest[at]};
    if (lowest > highest) return;  // nothing finite
    const bool isFace = glm::any(glm::equal(block, glm::ivec3{0})) ||
                        glm::any(glm::equal(block, blocks.blocks - 1));
    HighShare& share = isFace ? faces : within;
    share.sum += 0.5 * ((lowest >= boundary ? 1 : 0) + (highest >= boundary ? 1 : 0));
    share.blocks += 1;
  });
  if (within.blocks < kThinnest * (faces.blocks + within.blocks)) return Surroundings::kDark;
  const double lowAtFaces = 1 - faces.mean();
  const double lowWithin = 1 - within.mean();
  if (faces.mean() > 0.5 && lowAtFaces < kRare * lowWithin) return Surroundings::kBright;
  if (within.mean() > 0 && faces.mean() > kAsFrequent * within.mean()) return Surroundings::kNone;
  return Surroundings::kDark;
}

double bareShare(const node::BlockRanges& blocks, double outer, double inner) {
  double boundary = 0, bare = 0;
  for (std::size_t i = 0; i < blocks.lowest.size(); ++i) {
    const double lowest = double{blocks.lowest[i]};
    if (!(double{blocks.highest[i]} >= inner && lowest < inner)) continue;
    boundary += 1;
    bare += lowest < outer ? 1 : 0;
  }
  return boundary > 0 ? bare / boundary : 0;
}

}  // namespace burin::host
