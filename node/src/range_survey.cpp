#include "range_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "burin/common/error.hpp"
#include "voxel_access.hpp"

namespace burin::node {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What a minimum starts from.
template <typename Voxel>
constexpr Voxel kHighest = std::is_same_v<Voxel, float> ? static_cast<Voxel>(kInfinity)
                                                        : std::numeric_limits<Voxel>::max();
/// What a maximum starts from.
template <typename Voxel>
constexpr Voxel kLowest = std::is_same_v<Voxel, float> ? static_cast<Voxel>(-kInfinity)
                                                       : std::numeric_limits<Voxel>::min();

/// Blocks along each axis, rounded up. An axis of one voxel has one block.
glm::ivec3 blockCounts(const glm::ivec3& dims, int blockCells) {
  return glm::max((dims - 1 + (blockCells - 1)) / blockCells, glm::ivec3{1});
}

/// The blocks [first, last] along one axis that contain voxel i: two at a shared face.
struct BlockSpan {
  int first;
  int last;
};
BlockSpan blocksOfVoxel(int i, int blocks, int blockCells) {
  return {std::max(0, (i + blockCells - 1) / blockCells - 1), std::min(i / blockCells, blocks - 1)};
}

/// Keeps, for the current layer of blocks, the extremes of each column (x, block row): the inner
/// loops then run over whole rows of x, which the compiler vectorises, and x is reduced once per
/// layer.
template <typename Voxel>
class TypedRangeSurvey : public RangeSurvey {
 public:
  explicit TypedRangeSurvey(const glm::ivec3& dims)
      : dims_{dims}, width_{static_cast<std::size_t>(dims.x)}, row_(width_) {
    blocks_.blockCells = blockCellsFor(dims);
    blocks_.blocks = blockCounts(dims, blocks_.blockCells);
    const std::size_t count = static_cast<std::size_t>(blocks_.blocks.x) *
                              static_cast<std::size_t>(blocks_.blocks.y) *
                              static_cast<std::size_t>(blocks_.blocks.z);
    blocks_.lowest.assign(count, kInfinity);
    blocks_.highest.assign(count, -kInfinity);
    clearColumns();
  }

  void addSlice(int z, std::span<const std::byte> voxels) override {
    const BlockSpan layers = blocksOfVoxel(z, blocks_.blocks.z, blocks_.blockCells);
    if (layer_ != layers.first) {
      closeLayer();
      layer_ = layers.first;
    }
    addRows(voxels, true);
    if (layers.last == layers.first) return;
    closeLayer();
    layer_ = layers.last;
    addRows(voxels, false);
  }

  void finish(VolumeSurvey& survey) override {
    closeLayer();
    survey.nanCount = nanCount_;
    survey.infiniteCount = infiniteCount_;
    survey.blocks = std::move(blocks_);
  }

 private:
  void clearColumns() {
    const std::size_t size = width_ * static_cast<std::size_t>(blocks_.blocks.y);
    columnLowest_.assign(size, kHighest<Voxel>);
    columnHighest_.assign(size, kLowest<Voxel>);
  }

  void addRows(std::span<const std::byte> voxels, bool countUnusual) {
    for (int y = 0; y < dims_.y; ++y) {
      std::memcpy(row_.data(), voxels.data() + static_cast<std::size_t>(y) * width_ * sizeof(Voxel),
                  width_ * sizeof(Voxel));
      if constexpr (std::is_same_v<Voxel, float>) {
        if (countUnusual) countNonFinite();
      }
      const BlockSpan rows = blocksOfVoxel(y, blocks_.blocks.y, blocks_.blockCells);
      for (int b = rows.first; b <= rows.last; ++b) addRow(b);
    }
  }

  void addRow(int blockRow) {
    const std::size_t at = static_cast<std::size_t>(blockRow) * width_;
    Voxel* lowest = columnLowest_.data() + at;
    Voxel* highest = columnHighest_.data() + at;
    const Voxel* row = row_.data();
    for (std::size_t x = 0; x < width_; ++x) {
      if constexpr (std::is_same_v<Voxel, float>) {
        const bool finite = std::abs(row[x]) <= std::numeric_limits<float>::max();  // false for NaN
        const float low = finite ? row[x] : kInfinity;
        const float high = finite ? row[x] : -kInfinity;
        lowest[x] = low < lowest[x] ? low : lowest[x];
        highest[x] = high > highest[x] ? high : highest[x];
      } else {
        lowest[x] = std::min(lowest[x], row[x]);
        highest[x] = std::max(highest[x], row[x]);
      }
    }
  }

  void countNonFinite() {
    std::int32_t nans = 0;
    std::int32_t notFinite = 0;
    for (std::size_t x = 0; x < width_; ++x) {
      nans += row_[x] != row_[x] ? 1 : 0;
      notFinite += std::abs(row_[x]) <= std::numeric_limits<Voxel>::max() ? 0 : 1;
    }
    nanCount_ += nans;
    infiniteCount_ += notFinite - nans;
  }

  /// Reduces the columns over x into the blocks of the layer.
  void closeLayer() {
    if (layer_ < 0) return;
    for (int by = 0; by < blocks_.blocks.y; ++by) {
      for (int bx = 0; bx < blocks_.blocks.x; ++bx) closeBlock({bx, by, layer_});
    }
    clearColumns();
  }

  void closeBlock(const glm::ivec3& block) {
    const std::size_t row = static_cast<std::size_t>(block.y) * width_;
    const int first = block.x * blocks_.blockCells;
    const int last = std::min(first + blocks_.blockCells, dims_.x - 1);
    Voxel lowest = kHighest<Voxel>;
    Voxel highest = kLowest<Voxel>;
    for (int x = first; x <= last; ++x) {
      lowest = std::min(lowest, columnLowest_[row + static_cast<std::size_t>(x)]);
      highest = std::max(highest, columnHighest_[row + static_cast<std::size_t>(x)]);
    }
    if (lowest > highest) return;  // nothing finite, or nothing at all
    float& blockLowest = blocks_.lowest[blocks_.index(block)];
    float& blockHighest = blocks_.highest[blocks_.index(block)];
    blockLowest = std::min(blockLowest, static_cast<float>(lowest));
    blockHighest = std::max(blockHighest, static_cast<float>(highest));
  }

  glm::ivec3 dims_;
  std::size_t width_;
  BlockRanges blocks_;
  int layer_ = -1;  ///< block layer whose columns are being gathered
  std::vector<Voxel> row_;
  std::vector<Voxel> columnLowest_;
  std::vector<Voxel> columnHighest_;
  std::int64_t nanCount_ = 0;
  std::int64_t infiniteCount_ = 0;
};

}  // namespace

int blockCellsFor(const glm::ivec3& dims) {
  constexpr std::size_t kMostBlocks = std::size_t{1} << 19;
  for (const int cells : {4, 8})
    if (IndexBox{glm::ivec3{0}, blockCounts(dims, cells)}.count() <= kMostBlocks) return cells;
  return 16;
}

std::size_t BlockRanges::index(const glm::ivec3& block) const {
  const auto row = static_cast<std::size_t>(block.z) * static_cast<std::size_t>(blocks.y) +
                   static_cast<std::size_t>(block.y);
  return row * static_cast<std::size_t>(blocks.x) + static_cast<std::size_t>(block.x);
}

std::unique_ptr<RangeSurvey> makeRangeSurvey(const VolumeInfo& info) {
  return withVoxelType(info.type, [&](auto tag) -> std::unique_ptr<RangeSurvey> {
    return std::make_unique<TypedRangeSurvey<typename decltype(tag)::Type>>(info.grid.dims);
  });
}

}  // namespace burin::node
