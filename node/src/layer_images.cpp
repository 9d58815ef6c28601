#include "layer_images.hpp"

#include "frame_target.hpp"

namespace burin::node {

void LayerImages::resize(ImageSize size, std::size_t layers) {
  if (size == size_ && layers == framebuffers_.size()) return;
  framebuffers_.clear();
  texture_ = makeTexture(GL_TEXTURE_2D_ARRAY);
  gl().TextureStorage3D(texture_.id(), 1, GL_RGBA32F, size.width, size.height,
                        static_cast<GLsizei>(layers));
  for (std::size_t i = 0; i < layers; ++i) {
    Framebuffer framebuffer = makeFramebuffer();
    gl().NamedFramebufferTextureLayer(framebuffer.id(), GL_COLOR_ATTACHMENT0, texture_.id(), 0,
                                      static_cast<GLint>(i));
    checkComplete(framebuffer, size);
    framebuffers_.push_back(std::move(framebuffer));
  }
  size_ = size;
}

}  // namespace burin::node
