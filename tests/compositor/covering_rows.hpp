#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burin/compositor/composite_options.hpp"
#include "test_images.hpp"

namespace burin::compositor::test {

using BeautyAndSilhouette = Product<Channel<"beauty", Over>, Channel<"silhouette", Silhouette>>;

// The levels of each factor, those that cost least first.
enum class PixelType {
  kSilhouette,
  kSilhouetteDepth,
  kAffine,
  kOver,
  kOverHalf,
  kMaximum,
  kNearest,
  kBeautyAndSilhouette,
  kFlatRecords
};
enum class Transfers { kByValue, kPacked, kByReference };
enum class Drawn { kNothing, kOnePixel, kHundredth, kHalf, kAll };

/// One frame of the covering array. The seed decides what is drawn, the visibility order and the
/// root.
struct FrameRow {
  PixelType pixel = PixelType::kOver;
  std::optional<ScheduleKind> schedule;  ///< nullopt: chosen by the compositor
  Transfers transfers = Transfers::kByValue;
  int ranks = 1;
  ImageSize size{1, 1};
  Drawn drawn = Drawn::kAll;
  unsigned seed = 0;

  CompositeOptions options() const;
  std::vector<Rank> order() const;  ///< all ranks, front to back
  Rank root() const { return Rank{static_cast<int>(seed % static_cast<unsigned>(ranks))}; }
};

/// "Over_RadixK_Packed_7_509x503_Half".
std::string nameOf(const FrameRow& row);

/// What the array is made of besides pixel types, schedules, transfers and active fractions, of
/// which all levels are taken.
struct Extent {
  std::vector<int> ranks;        ///< ascending
  std::vector<ImageSize> sizes;  ///< smallest first
  double mostBytes = 0;          ///< of pixels in a frame's memory, all ranks together
};

/// Frames in which all pairs of levels meet. The same every time.
std::vector<FrameRow> coveringRows(const Extent& extent);

/// Calls `use(A{})` with the algebra of a pixel type.
template <typename Use>
auto withAlgebra(PixelType type, Use&& use) {
  switch (type) {
    case PixelType::kSilhouette:
      return use(Silhouette{});
    case PixelType::kSilhouetteDepth:
      return use(SilhouetteDepth{});
    case PixelType::kAffine:
      return use(Affine{});
    case PixelType::kOver:
      return use(Over{});
    case PixelType::kOverHalf:
      return use(OverHalf{});
    case PixelType::kMaximum:
      return use(Maximum{});
    case PixelType::kNearest:
      return use(Nearest{});
    case PixelType::kBeautyAndSilhouette:
      return use(BeautyAndSilhouette{});
    case PixelType::kFlatRecords:
      break;
  }
  return use(FlatRecords<4>{});
}

}  // namespace burin::compositor::test
