#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace burin::compositor {

/// All that some generators make by composition, numbered, with the multiplication table. Element 0
/// is the identity; then come the generators in their order, then what they make.
template <typename Element, std::size_t kSize>
struct Closure {
  static_assert(kSize <= 256);
  std::array<Element, kSize> elements{};
  std::array<std::array<std::uint8_t, kSize>, kSize> product{};
};

/// The closure of `generators` under `compose(front, back)`. For constant expressions: it does not
/// compile unless the closure has exactly kSize elements.
template <std::size_t kSize, typename Element, std::size_t kGenerators, typename Compose>
constexpr Closure<Element, kSize> closureOf(const Element& identity,
                                            const std::array<Element, kGenerators>& generators,
                                            Compose compose) {
  Closure<Element, kSize> closure;
  auto& elements = closure.elements;
  std::size_t size = 0;
  const auto numberOf = [&](const Element& element) {
    const auto end = elements.begin() + static_cast<std::ptrdiff_t>(size);
    return static_cast<std::size_t>(std::find(elements.begin(), end, element) - elements.begin());
  };
  const auto add = [&](const Element& element) {
    if (numberOf(element) < size) return;
    if (size == kSize) throw "more elements than expected";
    elements[size++] = element;
  };
  add(identity);
  for (const Element& generator : generators) add(generator);
  if (size != 1 + kGenerators) throw "equal generators";
  for (std::size_t i = 1; i < size; ++i) {  // grows while it runs
    for (const Element& generator : generators) add(compose(elements[i], generator));
  }
  if (size != kSize) throw "fewer elements than expected";
  for (std::size_t front = 0; front < kSize; ++front) {
    for (std::size_t back = 0; back < kSize; ++back) {
      const std::size_t number = numberOf(compose(elements[front], elements[back]));
      closure.product[front][back] = static_cast<std::uint8_t>(number);
    }
  }
  return closure;
}

}  // namespace burin::compositor
