#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/collect.hpp"
#include "burin/common/communicator.hpp"
#include "burin/common/image.hpp"

namespace burin::host::bench {

/// How IceT composites one image: its single-image strategies under the multi-tile strategy
/// "sequential", which its manual recommends for one display, and the two other multi-tile
/// strategies that keep a visibility order.
enum class IceTStrategy {
  kAutomatic,
  kBinarySwap,
  kTree,
  kRadixK,
  kRadixKr,
  kBinarySwapFolding,
  kReduce,
  kDirect,
};
inline constexpr std::array kIceTStrategies{
    IceTStrategy::kAutomatic, IceTStrategy::kBinarySwap, IceTStrategy::kTree,
    IceTStrategy::kRadixK,    IceTStrategy::kRadixKr,    IceTStrategy::kBinarySwapFolding,
    IceTStrategy::kReduce,    IceTStrategy::kDirect};

/// "automatic", "bswap", "tree", …: as in compositing.csv.
std::string_view strategyName(IceTStrategy strategy);

/// IceT, the compositor of ParaView and others, as a peer to measure against: one image for one
/// display, premultiplied float RGBA blended in visibility order over nothing, everything else as
/// IceT has it by default (active-pixel encoding, interlaced images, radix 8). Moreland, Kendall,
/// Peterka & Huang, "An Image Compositing Solution at Scale", SC 2011.
///
/// IceT numbers rows from the bottom; here they go in and come out from the top, which to a
/// compositor is a mirrored picture and nothing else. It takes a pixel with a = 0 for nothing.
class IceT {
 public:
  /// Collective. nullopt on all ranks alike if any of them cannot load the library (see
  /// loadIceT); then `whyNot` says which rank and why. Rank 0 of `comm` is the display rank.
  static std::optional<IceT> open(const Communicator& comm, std::string& whyNot);
  IceT(IceT&&) noexcept;
  IceT& operator=(IceT&&) noexcept;
  ~IceT();  ///< before MPI is finalized

  /// Local. What this rank drew, for the composites that follow: the pixels of rectangle `active`
  /// row by row; every other pixel of the frame is blank. The frame's size is the same on every
  /// rank. Throws std::logic_error if the rectangle is not in the frame or not of that many pixels.
  void setImage(ImageSize frame, const PixelRect& active, std::span<const Rgba> pixels);

  /// Collective. Composites the ranks' images; `order`: those that drew something, front to back,
  /// the same on every rank. With Collect::kYes the display rank gets the frame, the others
  /// nothing; with kNo every rank gets its part of the finished pixels (offset in the frame:
  /// partOffset()). What is returned lasts until the next call of this IceT. Throws Error{kRank} if
  /// IceT reports an error.
  std::span<const Rgba> composite(IceTStrategy strategy, std::span<const Rank> order,
                                  Collect collect);

  /// Of this rank in the last composite(), as IceT counts them (ICET_BYTES_SENT).
  std::int64_t bytesSent() const;
  /// Number of the first pixel that the last composite() returned.
  std::size_t partOffset() const;
  /// Whether images are interlaced: IceT's default, which this class leaves alone.
  bool interlaces() const;
  /// The library in use.
  const std::string& file() const;

 private:
  struct State;
  explicit IceT(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace burin::host::bench
