#pragma once

#include <array>

#include "brick_renderer.hpp"
#include "burin/common/image.hpp"
#include "gl.hpp"

namespace burin::node {

/// The pixels of a frame that bricks are blended into. Its OffscreenContext must be current.
class FrameTarget {
 public:
  /// `format`: GL_RGBA32F, GL_RGBA16F, GL_RGBA8 or GL_RG32F.
  explicit FrameTarget(GLenum format) : format_{format}, framebuffer_{makeFramebuffer()} {}

  /// Of that many pixels from now on. Throws Error{kRank} if there is no such target.
  void resize(ImageSize size);
  /// Makes it the target of draws, with `nothing` in `area` and nothing drawn outside of it until
  /// the scissor is set anew.
  void begin(const PixelRect& area, const std::array<float, 4>& nothing = {});
  GLuint texture() const { return texture_.id(); }
  void bind() const { gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id()); }
  /// What was drawn in `area`, as floats in the memory that `room` gives.
  std::span<const Rgba> read(const PixelRect& area, const PixelRoom& room) const;
  /// `channels` of it (GL_RED, GL_RG), as many floats per pixel.
  void read(const PixelRect& area, GLenum channels, std::span<float> into) const;

 private:
  GLenum format_;
  Texture texture_;
  Framebuffer framebuffer_;
  ImageSize size_;
};

/// Throws Error{kRank} if pixels of that format cannot be drawn into.
void checkComplete(const Framebuffer& framebuffer, ImageSize size);

}  // namespace burin::node
