#pragma once

#include <algorithm>
#include <string_view>

#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// A text that can be a template argument.
template <std::size_t kSize>
struct FixedString {
  std::array<char, kSize> text{};  // ends with a zero
  /// Implicit, so that Channel<"beauty", Over> can be written.
  constexpr FixedString(const char (&literal)[kSize]) { std::copy_n(literal, kSize, text.begin()); }
  constexpr std::string_view view() const { return {text.data(), kSize - 1}; }
};

/// One channel of a product: `A`'s pixels under a name.
template <FixedString kChannelName, PixelAlgebra A>
struct Channel {
  using Algebra = A;
  static constexpr std::string_view kName = kChannelName.view();
};

/// A channel's part of a product's pixel: a base of it, as std::tuple is not trivially copyable.
template <typename ChannelType>
struct ChannelValue {
  typename ChannelType::Algebra::Pixel value = ChannelType::Algebra::identity();
  friend bool operator==(const ChannelValue&, const ChannelValue&) = default;
};

template <typename... Channels>
struct ProductPixel : ChannelValue<Channels>... {
  friend bool operator==(const ProductPixel&, const ProductPixel&) = default;
};

namespace detail {

template <typename... Channels>
constexpr bool haveDistinctNames() {
  std::array names{Channels::kName...};
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) == names.end();
}

}  // namespace detail

/// Several named channels in one pixel and one message, each combined by its own algebra:
/// Product<Channel<"beauty", Over>, Channel<"silhouette", Silhouette>>. On the wire: the channels'
/// own forms in the order of the arguments.
template <typename... Channels>
struct Product {
  static_assert(sizeof...(Channels) >= 1);
  static_assert(detail::haveDistinctNames<Channels...>());
  using Pixel = ProductPixel<Channels...>;
  static constexpr std::array<std::string_view, sizeof...(Channels)> kNames{Channels::kName...};
  static constexpr std::size_t kMinWireBytes = (0 + ... + Channels::Algebra::kMinWireBytes);
  static constexpr std::size_t kMaxWireBytes = (0 + ... + Channels::Algebra::kMaxWireBytes);
  /// If all channels' are and there is no padding between them.
  static constexpr bool kWireIsMemory =
      (Channels::Algebra::kWireIsMemory && ...) && sizeof(Pixel) == kMaxWireBytes;

  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return {{Channels::Algebra::combine(valueOf<Channels>(front), valueOf<Channels>(back))}...};
  }
  static constexpr bool isIdentity(const Pixel& pixel) {
    return (Channels::Algebra::isIdentity(valueOf<Channels>(pixel)) && ...);
  }
  static std::size_t store(const Pixel& pixel, std::span<std::byte> out) {
    std::size_t length = 0;
    ((length += Channels::Algebra::store(valueOf<Channels>(pixel), out.subspan(length))), ...);
    return length;
  }
  static std::size_t load(std::span<const std::byte> in, Pixel& into) {
    std::size_t length = 0;
    const bool isWhole = (loadNext<Channels>(in, length, into) && ...);
    return isWhole ? length : 0;
  }

  /// The channel of that name: get<"beauty">(pixel). An unknown name does not compile.
  template <FixedString kName>
  static constexpr auto& get(Pixel& pixel) {
    return named<kName>(pixel);
  }
  template <FixedString kName>
  static constexpr const auto& get(const Pixel& pixel) {
    return named<kName>(pixel);
  }

 private:
  /// Converts a pixel to its base with that name.
  template <FixedString kName, typename A>
  static constexpr auto& named(ChannelValue<Channel<kName, A>>& channel) {
    return channel.value;
  }
  template <FixedString kName, typename A>
  static constexpr const auto& named(const ChannelValue<Channel<kName, A>>& channel) {
    return channel.value;
  }
  template <typename C>
  static constexpr const auto& valueOf(const Pixel& pixel) {
    return static_cast<const ChannelValue<C>&>(pixel).value;
  }
  template <typename C>
  static std::size_t loadNext(std::span<const std::byte> in, std::size_t& length, Pixel& into) {
    auto& value = static_cast<ChannelValue<C>&>(into).value;
    const std::size_t more = C::Algebra::load(in.subspan(length), value);
    length += more;
    return more;
  }
};

}  // namespace burin::compositor
