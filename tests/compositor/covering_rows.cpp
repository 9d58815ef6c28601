#include "covering_rows.hpp"

#include <fmt/format.h>

#include <array>

#include "all_pairs.hpp"

namespace burin::compositor::test {

namespace {

constexpr std::array kPixelNames{"Silhouette", "SilhouetteDepth", "Affine",
                                 "Over",       "OverHalf",        "Maximum",
                                 "Nearest",    "Product",         "FlatRecords"};
constexpr std::array<std::optional<ScheduleKind>, 5> kSchedules{
    std::nullopt, ScheduleKind::kBinarySwap, ScheduleKind::kRadixK, ScheduleKind::kDirectSend,
    ScheduleKind::kSerialGather};
constexpr std::array kScheduleNames{"BinarySwap", "RadixK", "DirectSend", "SerialGather"};
constexpr std::array kTransferNames{"ByValue", "Packed", "ByReference"};
constexpr std::array kDrawnNames{"Nothing", "OnePixel", "Hundredth", "Half", "All"};

template <std::size_t kSize, typename Level>
std::string nameIn(const std::array<const char*, kSize>& names, Level level) {
  return names[static_cast<std::size_t>(level)];
}

FrameRow rowOf(const Levels& levels, const Extent& extent, unsigned seed) {
  const auto at = [&](const auto& values, std::size_t factor) {
    return values[static_cast<std::size_t>(levels[factor])];
  };
  return {static_cast<PixelType>(levels[0]),
          at(kSchedules, 1),
          static_cast<Transfers>(levels[2]),
          at(extent.ranks, 3),
          at(extent.sizes, 4),
          static_cast<Drawn>(levels[5]),
          seed};
}

/// What compositeInProcess and its subimages need, nearly: a rank that shares memory has room for
/// the frame, what it drew and what it combines.
double bytesOf(const FrameRow& row) {
  const std::size_t pixelBytes = withAlgebra(
      row.pixel, [](auto algebra) { return sizeof(typename decltype(algebra)::Pixel); });
  const double frames = row.transfers == Transfers::kByReference ? 5 : 2;
  return frames * row.ranks * static_cast<double>(row.size.pixels() * pixelBytes);
}

}  // namespace

CompositeOptions FrameRow::options() const {
  CompositeOptions options;
  if (schedule) options.schedule = ScheduleOptions{*schedule};
  options.packing = transfers == Transfers::kPacked ? Packing::kAlways : Packing::kNever;
  options.isSharingMemory = transfers == Transfers::kByReference;
  options.root = root();
  return options;
}

std::vector<Rank> FrameRow::order() const {
  std::vector<Rank> order;
  Random random{seed};
  for (int i = 0; i < ranks; ++i) {
    order.insert(order.begin() + below(random, i + 1), Rank{i});
  }
  return order;
}

std::string nameOf(const FrameRow& row) {
  return fmt::format("{}_{}_{}_{}_{}x{}_{}", nameIn(kPixelNames, row.pixel),
                     row.schedule ? nameIn(kScheduleNames, *row.schedule) : "Auto",
                     nameIn(kTransferNames, row.transfers), row.ranks, row.size.width,
                     row.size.height, nameIn(kDrawnNames, row.drawn));
}

std::vector<FrameRow> coveringRows(const Extent& extent) {
  const Levels counts{kPixelNames.size(),
                      kSchedules.size(),
                      kTransferNames.size(),
                      static_cast<int>(extent.ranks.size()),
                      static_cast<int>(extent.sizes.size()),
                      kDrawnNames.size()};
  AllPairs array{
      counts,
      [&](const Levels& levels) { return bytesOf(rowOf(levels, extent, 0)) <= extent.mostBytes; },
      1};
  std::vector<FrameRow> rows;
  for (const Levels& levels : array.rows()) {
    rows.push_back(rowOf(levels, extent, static_cast<unsigned>(rows.size()) + 1));
  }
  return rows;
}

}  // namespace burin::compositor::test
