#include "bench/icet.hpp"

#include <algorithm>
#include <vector>

#include "bench/icet_library.hpp"
#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace {

struct StrategyEntry {
  std::string_view name;
  icet::Enum multiTile;
  icet::Enum singleImage;
};

/// In the order of IceTStrategy.
constexpr std::array<StrategyEntry, kIceTStrategies.size()> kStrategyTable{{
    {"automatic", icet::kStrategySequential, icet::kSingleAutomatic},
    {"bswap", icet::kStrategySequential, icet::kSingleBinarySwap},
    {"tree", icet::kStrategySequential, icet::kSingleTree},
    {"radix-k", icet::kStrategySequential, icet::kSingleRadixK},
    {"radix-kr", icet::kStrategySequential, icet::kSingleRadixKr},
    {"bswap-folding", icet::kStrategySequential, icet::kSingleBinarySwapFolding},
    {"reduce", icet::kStrategyReduce, icet::kSingleAutomatic},
    {"direct", icet::kStrategyDirect, icet::kSingleAutomatic},
}};

const StrategyEntry& entry(IceTStrategy strategy) {
  return kStrategyTable.at(static_cast<std::size_t>(strategy));
}

}  // namespace

std::string_view strategyName(IceTStrategy strategy) {
  return entry(strategy).name;
}

struct IceT::State {
  State(IceTLibrary loaded, const Communicator& comm)
      : library{std::move(loaded)}, ranks{comm.size()}, isDisplay{comm.isRoot()} {
    void* const communicator = library.createMpiCommunicator(comm.get());
    context = library.createContext(communicator);  // which duplicates it
    library.destroyMpiCommunicator(communicator);
    library.setContext(context);
    library.diagnostics(icet::kDiagnosticsOff);  // errors are asked for instead
    library.setColorFormat(icet::kColorRgbaFloat);
    library.setDepthFormat(icet::kDepthNone);
    library.compositeMode(icet::kCompositeModeBlend);
    library.enable(icet::kOrderedComposite);
  }
  ~State() {
    library.setContext(context);
    library.destroyContext(context);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::int64_t integer(icet::Enum name) const {
    std::int32_t value = 0;
    library.setContext(context);
    library.getIntegers(name, &value);
    return value;
  }

  /// IceT wants every rank in its order; those that drew nothing go to the back.
  void setOrder(std::span<const Rank> order) {
    wholeOrder.clear();
    for (const Rank rank : order) wholeOrder.push_back(static_cast<std::int32_t>(rank));
    const auto named = static_cast<std::ptrdiff_t>(wholeOrder.size());
    for (std::int32_t rank = 0; rank < ranks; ++rank) {
      const auto end = wholeOrder.begin() + named;
      if (std::find(wholeOrder.begin(), end, rank) == end) wholeOrder.push_back(rank);
    }
    BURIN_CHECK_EQ(static_cast<int>(wholeOrder.size()), ranks);
    library.compositeOrder(wholeOrder.data());
  }

  /// IceT's last error may be of any context of this process, so it is asked for after each call.
  void checkError(std::string_view strategy) const {
    const icet::Enum code = library.getError();
    if (code != icet::kNoError)
      fail(ExitCode::kRank, "IceT, strategy {}: error {:#x}", strategy, code);
  }

  IceTLibrary library;
  int ranks;
  bool isDisplay;
  void* context = nullptr;
  Image<Rgba> image;  ///< the whole frame, as IceT wants it
  PixelRect active;
  std::vector<std::int32_t> wholeOrder;
  std::size_t partOffset = 0;
};

IceT::IceT(std::unique_ptr<State> state) : state_{std::move(state)} {}
IceT::IceT(IceT&&) noexcept = default;
IceT& IceT::operator=(IceT&&) noexcept = default;
IceT::~IceT() = default;

std::optional<IceT> IceT::open(const Communicator& comm, std::string& whyNot) {
  IceTLibrary library{};
  try {
    collectively(comm, "IceT", [&] { library = loadIceT(); });
  } catch (const CollectiveError& error) {
    whyNot = error.what();
    return std::nullopt;
  }
  return IceT{std::make_unique<State>(std::move(library), comm)};
}

void IceT::setImage(ImageSize frame, const PixelRect& active, std::span<const Rgba> pixels) {
  BURIN_CHECK_EQ(active.pixels(), pixels.size());
  Image<Rgba>& image = state_->image;
  if (image.size() != frame) {
    image = Image<Rgba>{frame};
    state_->active = {};
    state_->library.setContext(state_->context);
    state_->library.resetTiles();
    state_->library.addTile(0, 0, frame.width, frame.height, 0);
  }
  const auto rowPart = [&](const PixelRect& rect, int y) {
    return image.row(y).subspan(static_cast<std::size_t>(rect.x0),
                                static_cast<std::size_t>(rect.width()));
  };
  const PixelRect whole{0, 0, frame.width, frame.height};
  BURIN_CHECK(active.empty() || intersection(active, whole) == active);
  if (state_->active != active) {
    const PixelRect& old = state_->active;
    for (int y = old.y0; y < old.y1; ++y) std::ranges::fill(rowPart(old, y), Rgba{});
  }
  state_->active = active.empty() ? PixelRect{} : active;
  const auto width = static_cast<std::size_t>(active.width());
  for (int y = state_->active.y0; y < state_->active.y1; ++y) {
    const auto from = pixels.subspan(static_cast<std::size_t>(y - active.y0) * width, width);
    std::ranges::copy(from, rowPart(active, y).begin());
  }
}

std::span<const Rgba> IceT::composite(IceTStrategy strategy, std::span<const Rank> order,
                                      Collect collect) {
  State& state = *state_;
  const IceTLibrary& library = state.library;
  library.setContext(state.context);
  library.strategy(entry(strategy).multiTile);
  library.singleImageStrategy(entry(strategy).singleImage);
  (collect == Collect::kYes ? library.enable : library.disable)(icet::kCollectImages);
  state.setOrder(order);
  const PixelRect& active = state.active;
  const std::array<std::int32_t, 4> valid{active.x0, active.y0, active.width(), active.height()};
  constexpr std::array<float, 4> kNothing{};
  const icet::Image result = library.compositeImage(
      state.image.pixels().data(), nullptr, valid.data(), nullptr, nullptr, kNothing.data());
  state.checkError(entry(strategy).name);

  state.partOffset = 0;
  const bool isWhole = collect == Collect::kYes;
  if (isWhole && !state.isDisplay) return {};
  if (!isWhole && state.integer(icet::kValidPixelsTile) < 0) return {};
  if (!isWhole)
    state.partOffset = static_cast<std::size_t>(state.integer(icet::kValidPixelsOffset));
  const auto number = isWhole ? state.image.size().pixels()
                              : static_cast<std::size_t>(state.integer(icet::kValidPixelsNumber));
  BURIN_CHECK(state.partOffset + number <= static_cast<std::size_t>(library.imagePixels(result)));
  // Four floats r, g, b, a, as Rgba has them.
  static_assert(sizeof(Rgba) == 4 * sizeof(float));
  const auto* pixels = reinterpret_cast<const Rgba*>(library.imageColour(result));
  state.checkError(entry(strategy).name);
  return {pixels + state.partOffset, number};
}

std::int64_t IceT::bytesSent() const {
  return state_->integer(icet::kBytesSent);
}

std::size_t IceT::partOffset() const {
  return state_->partOffset;
}

bool IceT::interlaces() const {
  state_->library.setContext(state_->context);
  return state_->library.isEnabled(icet::kInterlaceImages) != 0;
}

const std::string& IceT::file() const {
  return state_->library.file;
}

}  // namespace burin::host::bench
