#include "burin/common/colour.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "burin/common/error.hpp"

namespace burin {

namespace {

std::optional<std::uint8_t> hexDigit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<std::uint8_t>(c - 'A' + 10);
  return std::nullopt;
}

std::array<double, 256> linearOfEveryCode() {
  std::array<double, 256> linear;
  for (std::size_t code = 0; code < linear.size(); ++code)
    linear[code] = linearFromSrgb(static_cast<double>(code) / 255.0);
  return linear;
}

}  // namespace

glm::dvec3 Colour::linear() const {
  // Transfer functions ask at every sample of the reference: a power for each would be a third of
  // its time.
  static const std::array<double, 256> kLinear = linearOfEveryCode();
  return {kLinear[r], kLinear[g], kLinear[b]};
}

std::string Colour::hex() const {
  return fmt::format("#{:02x}{:02x}{:02x}", r, g, b);
}

Colour parseColour(std::string_view text) {
  const auto refuse = [&]() {
    fail(ExitCode::kUsage, "'{}' is no colour: expected \"#rrggbb\"", text);
  };
  if ((text.size() != 7 && text.size() != 4) || text[0] != '#') refuse();
  const std::size_t digits = text.size() == 7 ? 2 : 1;
  std::uint8_t channels[3] = {};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto high = hexDigit(text[1 + channel * digits]);
    const auto low = hexDigit(text[channel * digits + digits]);  // "#rgb": the same digit twice
    if (!high || !low) refuse();
    channels[channel] = static_cast<std::uint8_t>(*high * 16 + *low);
  }
  return {channels[0], channels[1], channels[2]};
}

double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace burin
