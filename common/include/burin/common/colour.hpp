#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace burin {

/// A colour as people write it: sRGB, 8 bits per channel, "#rrggbb". Linear light inside.
struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  glm::dvec3 linear() const;
  std::string hex() const;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// From "#rrggbb" or "#rgb". Throws Error{kUsage} naming the text.
Colour parseColour(std::string_view text);

/// IEC 61966-2-1 transfer curve and its inverse, on [0, 1].
double linearFromSrgb(double encoded);
double srgbFromLinear(double linear);

}  // namespace burin
