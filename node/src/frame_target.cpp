#include "frame_target.hpp"

#include "burin/common/error.hpp"

namespace burin::node {

void checkComplete(const Framebuffer& framebuffer, ImageSize size) {
  const GLenum status = gl().CheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    fail(ExitCode::kRank, "no target of {}x{} pixels to draw into (OpenGL status {:#x})",
         size.width, size.height, status);
}

void FrameTarget::resize(ImageSize size) {
  if (size == size_) return;
  texture_ = makeTexture(GL_TEXTURE_2D);
  gl().TextureStorage2D(texture_.id(), 1, format_, size.width, size.height);
  gl().NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, texture_.id(), 0);
  checkComplete(framebuffer_, size);
  size_ = size;
}

void FrameTarget::begin(const PixelRect& area, const std::array<float, 4>& nothing) {
  bind();
  gl().Viewport(0, 0, size_.width, size_.height);
  gl().Disable(GL_DITHER);
  gl().Enable(GL_SCISSOR_TEST);
  gl().Scissor(area.x0, area.y0, area.width(), area.height());
  gl().ClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, nothing.data());
}

std::span<const Rgba> FrameTarget::read(const PixelRect& area, const PixelRoom& room) const {
  bind();
  const std::span<Rgba> pixels = room(area.pixels());
  gl().ReadPixels(area.x0, area.y0, area.width(), area.height(), GL_RGBA, GL_FLOAT, pixels.data());
  return pixels;
}

void FrameTarget::read(const PixelRect& area, GLenum channels, std::span<float> into) const {
  BURIN_CHECK_EQ(into.size(), area.pixels() * (channels == GL_RED ? 1u : 2u));
  bind();
  gl().ReadPixels(area.x0, area.y0, area.width(), area.height(), channels, GL_FLOAT, into.data());
}

}  // namespace burin::node
