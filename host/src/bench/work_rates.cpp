#include "bench/work_rates.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <utility>
#include <vector>

#include "burin/compositor/combine_tiles.hpp"
#include "burin/compositor/tile_message.hpp"

namespace burin::host::bench {

namespace {

using namespace compositor;

/// Median seconds of a call.
template <typename Work>
double timeOf(Work&& work) {
  constexpr int kRepeats = 5;
  std::array<double, kRepeats> times{};
  for (double& time : times) {
    const auto start = std::chrono::steady_clock::now();
    work();
    time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::ranges::sort(times);
  return times[kRepeats / 2];
}

std::size_t activeOf(const SparseImage<Rgba>& image) {
  std::size_t active = 0;
  for (const auto& tile : image) active += tile.active;
  return active;
}

/// A subimage as one message, and what becomes of it.
class Sample {
 public:
  explicit Sample(const Subimage<Rgba>& image)
      : image_{image.frame, image.active, image.pixels}, grid_{image.frame}, frame_{image.frame} {
    tiles_ = compress<Over>(image_, grid_, Keep::kInPlace, {memory_, memory_});
    active_ = static_cast<double>(activeOf(tiles_));
  }
  bool empty() const { return active_ == 0.0; }

  WorkRates rates() {
    WorkRates rates;
    rates.perScannedPixel = timeOf([&] { scan(); }) / static_cast<double>(image_.pixels.size());
    rates.perCombinedPixel = timeOf([&] { combine(); }) / (2.0 * active_);
    rates.perPastedPixel = timeOf([&] { paste(); }) / active_;
    const auto [encode, decode] = perByte(false);
    const auto [pack, unpack] = perByte(true);
    rates.perEncodedByte = encode;
    rates.perDecodedByte = decode;
    rates.perPackedByte = std::max(0.0, pack - encode);
    rates.perUnpackedByte = std::max(0.0, unpack - decode);
    return rates;
  }

 private:
  void scan() {
    scratch_.reset();
    compress<Over>(image_, grid_, Keep::kInPlace, {scratch_, scratch_});
  }
  void combine() {
    scratch_.reset();
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const std::array pair{tiles_[i], tiles_[i]};
      combiner_.fold(pair, grid_.pixels(i), {scratch_, scratch_});
    }
  }
  void paste() {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!tiles_[i].empty()) pasteTile<Over>(tiles_[i], grid_.rect(i), frame_);
    }
  }
  /// Of making and taking apart.
  std::pair<double, double> perByte(bool isPacked) {
    const Region all{0, tiles_.size()};
    EncodedMessage message;
    const double making = timeOf([&] {
      scratch_.reset();
      message = encodeTiles<Over>(std::span<const SparseTile<Rgba>>{tiles_}, all,
                                  {nullptr, isPacked}, scratch_);
    });
    const auto bytes = static_cast<double>(message.bytes.size() + message.packedAway);
    FrameMemory room;
    const double taking = timeOf([&] {
      room.reset();
      decodeTiles<Over>(
          message.bytes, all, [&](std::size_t tile) { return grid_.rect(tile); }, SharedSpaces{},
          room);
    });
    return {making / bytes, taking / bytes};
  }

  SubimageView<Rgba> image_;
  TileGrid grid_;
  Image<Rgba> frame_;
  FrameMemory memory_, scratch_;
  TileCombiner<Over> combiner_;
  SparseImage<Rgba> tiles_;
  double active_ = 0.0;
};

}  // namespace

WorkRates measureWorkRates(const Communicator& comm, const Subimage<Rgba>& mine) {
  Sample sample{mine};
  const auto sizes = allGather(comm, mine.pixels.size());
  const auto largest = static_cast<int>(std::ranges::max_element(sizes) - sizes.begin());
  WorkRates rates;
  if (static_cast<int>(comm.rank()) == largest && !sample.empty()) rates = sample.rates();
  broadcastBytes(comm, std::as_writable_bytes(std::span{&rates, 1}), Rank{largest});
  return rates;
}

}  // namespace burin::host::bench
