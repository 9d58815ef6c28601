#include "bench/picture_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace {

/// CIE L*a*b* of a linear sRGB colour, white point D65 (CIE 15:2004; IEC 61966-2-1's primaries).
glm::dvec3 labOf(const glm::dvec3& linear) {
  const glm::dvec3 c = glm::clamp(linear, 0.0, 1.0);
  const glm::dvec3 relative{
      (0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b) / 0.9505,
      0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b,
      (0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b) / 1.089,
  };
  constexpr double kEdge = 6.0 / 29;
  const auto f = [](double t) {
    return t > kEdge * kEdge * kEdge ? std::cbrt(t) : t / (3 * kEdge * kEdge) + 4.0 / 29;
  };
  const glm::dvec3 v{f(relative.x), f(relative.y), f(relative.z)};
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

glm::dvec3 onWhite(const Rgba& p) {
  return glm::dvec3{p.r, p.g, p.b} + (1.0 - double{p.a});
}

}  // namespace

PictureError pictureError(ImageView<const Rgba> picture, ImageView<const Rgba> truth) {
  const ImageSize size = truth.size();
  BURIN_CHECK(picture.size() == size);
  PictureError error;
  double squares = 0;
  std::vector<double> differences;
  differences.reserve(size.pixels());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Rgba& a = picture.row(y)[static_cast<std::size_t>(x)];
      const Rgba& b = truth.row(y)[static_cast<std::size_t>(x)];
      for (const double d : {double{a.r} - double{b.r}, double{a.g} - double{b.g},
                             double{a.b} - double{b.b}, double{a.a} - double{b.a}}) {
        error.largest = std::max(error.largest, std::abs(d));
        squares += d * d;
      }
      differences.push_back(glm::distance(labOf(onWhite(a)), labOf(onWhite(b))));
    }
  error.rms = std::sqrt(squares / (4.0 * static_cast<double>(size.pixels())));
  const auto place = differences.begin() +
                     static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(differences.size()));
  std::ranges::nth_element(differences, place);
  error.deltaE = *place;
  return error;
}

}  // namespace burin::host::bench
