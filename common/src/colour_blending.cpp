#include <algorithm>
#include <cmath>
#include <numbers>

#include "burin/common/colour.hpp"
#include "burin/common/colour_map.hpp"

namespace burin {

namespace {

using std::numbers::pi;

/// CIE XYZ of the white that L*a*b* refers to: D65.
constexpr glm::dvec3 kWhite{0.9505, 1.0, 1.089};

// Rows of the matrices between linear sRGB and XYZ, to the digits that VTK has.
constexpr glm::dvec3 kXyzOf[] = {
    {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
constexpr glm::dvec3 kRgbOf[] = {
    {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};

glm::dvec3 times(const glm::dvec3 (&rows)[3], const glm::dvec3& v) {
  return {glm::dot(rows[0], v), glm::dot(rows[1], v), glm::dot(rows[2], v)};
}

constexpr double kLinearBelow = 0.008856;  // of L*a*b*'s cube root
constexpr double kSlope = 7.787;
constexpr double kOffset = 16.0 / 116;

glm::dvec3 labFromSrgb(const glm::dvec3& srgb) {
  const glm::dvec3 linear{linearFromSrgb(srgb.r), linearFromSrgb(srgb.g), linearFromSrgb(srgb.b)};
  glm::dvec3 f = times(kXyzOf, linear) / kWhite;
  for (int i = 0; i < 3; ++i)
    f[i] = f[i] > kLinearBelow ? std::cbrt(f[i]) : kSlope * f[i] + kOffset;
  return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

glm::dvec3 srgbFromLab(const glm::dvec3& lab) {
  const double y = (lab.x + 16) / 116;
  glm::dvec3 f{lab.y / 500 + y, y, y - lab.z / 200};
  for (int i = 0; i < 3; ++i) {
    const double cube = f[i] * f[i] * f[i];
    f[i] = cube > kLinearBelow ? cube : (f[i] - kOffset) / kSlope;
  }
  const glm::dvec3 linear = times(kRgbOf, f * kWhite);
  glm::dvec3 srgb{srgbFromLinear(linear.r), srgbFromLinear(linear.g), srgbFromLinear(linear.b)};
  srgb /= std::max({1.0, srgb.r, srgb.g, srgb.b});
  return glm::max(srgb, 0.0);
}

/// Moreland's polar form of L*a*b*: magnitude, saturation (an angle), hue (an angle).
struct Msh {
  double magnitude;
  double saturation;
  double hue;
};

Msh mshFromLab(const glm::dvec3& lab) {
  constexpr double kNone = 0.001;
  const double magnitude = glm::length(lab);
  const double saturation = magnitude > kNone ? std::acos(lab.x / magnitude) : 0;
  return {magnitude, saturation, saturation > kNone ? std::atan2(lab.z, lab.y) : 0};
}

glm::dvec3 labFromMsh(const Msh& msh) {
  return msh.magnitude * glm::dvec3{std::cos(msh.saturation),
                                    std::sin(msh.saturation) * std::cos(msh.hue),
                                    std::sin(msh.saturation) * std::sin(msh.hue)};
}

double angleBetween(double a, double b) {
  const double difference = std::fmod(std::abs(a - b), 2 * pi);
  return std::min(difference, 2 * pi - difference);
}

constexpr double kUnsaturated = 0.05;

/// The hue that an unsaturated colour of that magnitude should have beside a saturated one, so that
/// steps between them look alike.
double hueBeside(const Msh& saturated, double magnitude) {
  if (saturated.magnitude >= magnitude - 0.1) return saturated.hue;
  const double spin = saturated.saturation *
                      std::sqrt(magnitude * magnitude - saturated.magnitude * saturated.magnitude) /
                      (saturated.magnitude * std::sin(saturated.saturation));
  return saturated.hue > -0.3 * pi ? saturated.hue + spin : saturated.hue - spin;
}

glm::dvec3 blendDiverging(const glm::dvec3& from, const glm::dvec3& to, double t) {
  constexpr double kDistinct = 0.33 * pi;
  constexpr double kWhiteMagnitude = 88;
  Msh a = mshFromLab(labFromSrgb(from));
  Msh b = mshFromLab(labFromSrgb(to));
  const bool aHasHue = a.saturation > kUnsaturated;
  const bool bHasHue = b.saturation > kUnsaturated;
  if (aHasHue && bHasHue && angleBetween(a.hue, b.hue) > kDistinct) {
    const Msh white{std::max({a.magnitude, b.magnitude, kWhiteMagnitude}), 0, 0};
    (t < 0.5 ? b : a) = white;
    t = t < 0.5 ? 2 * t : 2 * t - 1;
  }
  if (a.saturation < kUnsaturated && b.saturation > kUnsaturated) {
    a.hue = hueBeside(b, a.magnitude);
  } else if (b.saturation < kUnsaturated && a.saturation > kUnsaturated) {
    b.hue = hueBeside(a, b.magnitude);
  }
  const auto mix = [t](double x, double y) { return (1 - t) * x + t * y; };
  return srgbFromLab(labFromMsh(
      {mix(a.magnitude, b.magnitude), mix(a.saturation, b.saturation), mix(a.hue, b.hue)}));
}

/// Hue in turns [0, 1), saturation, value.
glm::dvec3 hsvFromRgb(const glm::dvec3& c) {
  const double value = std::max({c.r, c.g, c.b});
  const double chroma = value - std::min({c.r, c.g, c.b});
  if (!(chroma > 0)) return {0, 0, value};
  double sixths = 0;
  if (value == c.r) {
    sixths = (c.g - c.b) / chroma;
  } else if (value == c.g) {
    sixths = 2 + (c.b - c.r) / chroma;
  } else {
    sixths = 4 + (c.r - c.g) / chroma;
  }
  return {sixths < 0 ? sixths / 6 + 1 : sixths / 6, chroma / value, value};
}

glm::dvec3 rgbFromHsv(const glm::dvec3& hsv) {
  const auto channel = [&](double n) {
    const double k = std::fmod(n + 6 * hsv.x, 6.0);
    return hsv.z * (1 - hsv.y * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

glm::dvec3 blendHsv(const glm::dvec3& from, const glm::dvec3& to, bool hueWraps, double t) {
  glm::dvec3 a = hsvFromRgb(from);
  glm::dvec3 b = hsvFromRgb(to);
  if (hueWraps && std::abs(a.x - b.x) > 0.5) (a.x < b.x ? a.x : b.x) += 1;
  glm::dvec3 mixed = (1 - t) * a + t * b;
  if (mixed.x > 1) mixed.x -= 1;
  return rgbFromHsv(mixed);
}

}  // namespace

glm::dvec3 blendColours(ColourSpace space, bool hueWraps, const glm::dvec3& a, const glm::dvec3& b,
                        double t) {
  switch (space) {
    case ColourSpace::kHsv:
      return blendHsv(a, b, hueWraps, t);
    case ColourSpace::kLab:
      return srgbFromLab((1 - t) * labFromSrgb(a) + t * labFromSrgb(b));
    case ColourSpace::kDiverging:
      return blendDiverging(a, b, t);
    case ColourSpace::kStep:
      return b;
    case ColourSpace::kRgb:
      break;
  }
  return (1 - t) * a + t * b;
}

double nodeWeight(double t, double midpoint, double sharpness) {
  constexpr double kLinear = 0.01;
  constexpr double kStep = 0.99;
  double s = t < midpoint ? 0.5 * t / midpoint : 1 - 0.5 * (1 - t) / (1 - midpoint);
  if (midpoint >= 1) s = 0.5 * t;
  if (sharpness > kStep) return s < 0.5 ? 0 : 1;
  if (sharpness < kLinear) return s;
  const double power = 1 + 10 * sharpness;
  s = s < 0.5 ? 0.5 * std::pow(2 * s, power) : 1 - 0.5 * std::pow(2 - 2 * s, power);
  // Hermite's cubic from 0 to 1; sharper ones are flatter at the ends.
  const double rise = s * s * (3 - 2 * s);
  const double slopes = s * (1 - s) * (1 - 2 * s);
  return std::clamp(rise + (1 - sharpness) * slopes, 0.0, 1.0);
}

}  // namespace burin
