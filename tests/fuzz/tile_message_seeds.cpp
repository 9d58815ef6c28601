#include "../compositor/random_pixels.hpp"
#include "burin/compositor/tile_message.hpp"
#include "fuzzed_frame.hpp"
#include "tile_messages.hpp"

namespace burin::compositor::fuzz {

namespace {

enum class Way { kByValue, kPacked, kByReference, kInPlace };
constexpr std::array kWays{Way::kByValue, Way::kPacked, Way::kByReference, Way::kInPlace};
constexpr std::array kWayNames{"value", "packed", "reference", "in_place"};
constexpr std::array<const char*, kAlgebras> kAlgebraNames{
    "over", "over_half", "nearest", "silhouette", "silhouette_depth", "flat", "layered", "deep"};

/// About 20 pixels here and there, so that a seed stays short; of one colour if they are to be
/// packed.
template <PixelAlgebra A>
Subimage<typename A::Pixel> drawn(const PixelRect& active, Way way) {
  test::Random random{31};
  auto colour = A::identity();
  while (A::isIdentity(colour)) colour = test::randomPixel(A{}, random);
  Subimage<typename A::Pixel> image{kFrame, active, {}};
  const int rarity = static_cast<int>(active.pixels()) / 20;
  for (std::size_t i = 0; i < active.pixels(); ++i) {
    const bool isHole = test::below(random, rarity) != 0;
    const auto pixel = way == Way::kPacked ? colour : test::randomPixel(A{}, random);
    image.pixels.push_back(isHole ? A::identity() : pixel);
  }
  return image;
}

/// zstd's frame, the end of `seed`, without its checksum: no change of its content would survive
/// that. RFC 8878, 3.1.1.1.1: bit 2 of the byte behind the magic number announces the checksum, the
/// last four bytes.
Seed withoutChecksum(Seed seed, std::size_t frameBegin) {
  seed.name += "_unchecked";
  seed.bytes.at(frameBegin + 4) &= ~std::byte{4};
  seed.bytes.resize(seed.bytes.size() - 4);
  return seed;
}

template <PixelAlgebra A>
void addSeeds(std::vector<Seed>& seeds, Choice choice, std::size_t wayIndex) {
  using Pixel = typename A::Pixel;
  const Way way = kWays[wayIndex];
  // Its pixels lie at the same offsets as in the memory that walkTileMessage() has; they differ.
  FuzzedMemory shared;
  const SharedSpaces spaces = shared.spaces();
  choice.hasSpaces = way == Way::kByReference || way == Way::kInPlace;
  FrameMemory pixels = choice.hasSpaces ? FrameMemory{shared.large()} : FrameMemory{};
  FrameMemory messages;

  const PixelRect active =
      way == Way::kInPlace ? PixelRect{250, 0, 272, 24} : PixelRect{0, 0, kFrame.width, 24};
  const Subimage<Pixel> image = drawn<A>(active, way);
  const auto canvas = pixels.allocate<Pixel>(image.pixels.size());
  std::ranges::copy(image.pixels, canvas.begin());
  const SubimageView<Pixel> view{kFrame, active, canvas};

  std::vector<SparseTile<Pixel>> tiles;
  RunList list;
  Walked content;
  std::size_t runs = 0;
  for (const PixelRect& rect : kTiles) {
    tiles.push_back(compressTile<A>(view, rect, way == Way::kInPlace ? Keep::kInPlace : Keep::kCopy,
                                    {pixels, messages}, list));
    runs += tiles.back().runs.size();
    content.tiles += tiles.back().empty() ? 0U : 1U;
    content.active += tiles.back().active;
  }
  const Transfer transfer{choice.hasSpaces ? &spaces : nullptr, way == Way::kPacked};
  const EncodedMessage message =
      encodeTiles<A>(std::span<const SparseTile<Pixel>>{tiles}, kRegion, transfer, messages);
  for (const bool isMisaligned : {false, true}) {
    choice.isMisaligned = isMisaligned;
    Seed seed{kAlgebraNames[choice.algebra], {choice.byte()}, content};
    seed.name += std::string{"_"} + kWayNames[wayIndex] + (isMisaligned ? "_misaligned" : "");
    seed.bytes.insert(seed.bytes.end(), message.bytes.begin(), message.bytes.end());
    seeds.push_back(seed);
    if (message.packedAway > 0) {
      const MessageLayout layout{content.tiles, runs, false};
      seeds.push_back(withoutChecksum(seed, 1 + layout.payloadBegin()));
    }
  }
}

}  // namespace

std::vector<Seed> tileMessageSeeds() {
  std::vector<Seed> seeds;
  for (std::uint8_t algebra = 0; algebra < kAlgebras; ++algebra) {
    withAlgebra(algebra, [&]<PixelAlgebra A>() {
      const Choice choice{algebra, false, false};
      for (std::size_t way = 0; way < kWays.size(); ++way) addSeeds<A>(seeds, choice, way);
      Seed nothing{kAlgebraNames[algebra] + std::string{"_nothing"}, {choice.byte()}, {}};
      const auto message = emptyTileMessage(kRegion, A::kMaxWireBytes);
      nothing.bytes.insert(nothing.bytes.end(), message.begin(), message.end());
      seeds.push_back(std::move(nothing));
    });
  }
  return seeds;
}

}  // namespace burin::compositor::fuzz
