#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "burin/common/camera.hpp"

namespace burin {

/// Pixels [x0, x1) × [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  int width() const { return empty() ? 0 : x1 - x0; }
  int height() const { return empty() ? 0 : y1 - y0; }
  std::size_t pixels() const;
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};
PixelRect intersection(const PixelRect& a, const PixelRect& b);
/// Smallest rectangle around both; an empty one does not count.
PixelRect boundingRect(const PixelRect& a, const PixelRect& b);

/// Premultiplied, linear light.
struct Rgba {
  float r = 0, g = 0, b = 0, a = 0;
  friend bool operator==(const Rgba&, const Rgba&) = default;
};

/// `front` over `back`, both premultiplied: C = F + (1 - a_F) B, for r, g, b and a alike.
/// Porter & Duff, "Compositing Digital Images", SIGGRAPH 1984 (the over operator).
constexpr Rgba over(const Rgba& front, const Rgba& back) {
  const float t = 1.0f - front.a;
  return {front.r + t * back.r, front.g + t * back.g, front.b + t * back.b, front.a + t * back.a};
}

/// An image whose pixels lie somewhere else. Rows top to bottom, pixels left to right.
template <typename Pixel>
class ImageView {
 public:
  ImageView() = default;
  /// `pixels`: size.pixels() of them.
  ImageView(ImageSize size, std::span<Pixel> pixels) : size_{size}, pixels_{pixels} {}
  ImageSize size() const { return size_; }
  std::span<Pixel> pixels() const { return pixels_; }
  std::span<Pixel> row(int y) const {
    return pixels_.subspan(offset(y), static_cast<std::size_t>(size_.width));
  }
  Pixel& at(int x, int y) const { return pixels_[offset(y) + static_cast<std::size_t>(x)]; }

 private:
  std::size_t offset(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width);
  }
  ImageSize size_{0, 0};
  std::span<Pixel> pixels_;
};

/// Rows top to bottom, pixels left to right.
template <typename Pixel>
class Image {
 public:
  Image() = default;
  explicit Image(ImageSize size) : size_{size}, pixels_(size.pixels()) {}
  operator ImageView<const Pixel>() const { return {size_, pixels_}; }
  operator ImageView<Pixel>() { return {size_, pixels_}; }
  ImageSize size() const { return size_; }
  std::span<Pixel> pixels() { return pixels_; }
  std::span<const Pixel> pixels() const { return pixels_; }
  std::span<Pixel> row(int y) { return pixels().subspan(offset(y), width()); }
  std::span<const Pixel> row(int y) const { return pixels().subspan(offset(y), width()); }
  Pixel& at(int x, int y) { return pixels_[offset(y) + static_cast<std::size_t>(x)]; }
  const Pixel& at(int x, int y) const { return pixels_[offset(y) + static_cast<std::size_t>(x)]; }

 private:
  std::size_t width() const { return static_cast<std::size_t>(size_.width); }
  std::size_t offset(int y) const { return static_cast<std::size_t>(y) * width(); }
  ImageSize size_;
  std::vector<Pixel> pixels_;
};

}  // namespace burin
