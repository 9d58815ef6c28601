#pragma once

#include <vector>

#include "burin/common/image.hpp"
#include "gl.hpp"

namespace burin::node {

/// An image of floats per layer: (colour, optical depth) of one slice, before layers are summed.
/// Its OffscreenContext must be current.
class LayerImages {
 public:
  /// That many images of that size from now on. Throws Error{kRank} if there is no such target.
  void resize(ImageSize size, std::size_t layers);

  /// Makes an image the target of draws.
  void bind(std::size_t layer) const {
    gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[layer].id());
  }
  GLuint texture() const { return texture_.id(); }

 private:
  Texture texture_;
  std::vector<Framebuffer> framebuffers_;
  ImageSize size_;
};

}  // namespace burin::node
