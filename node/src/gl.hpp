#pragma once

#include <glad/gl.h>

#include <string_view>
#include <utility>

namespace burin::node {

/// The function table of the context current on this thread; set by OffscreenContext.
const GladGLContext& gl();
void setCurrentGl(const GladGLContext* context) noexcept;
/// To be called before that context goes away; another one that is current stays so.
void forgetCurrentGl(const GladGLContext* context) noexcept;

/// Throws Error{kRank} "<what>: GL error …" if an error is pending.
void checkGl(std::string_view what);

/// Owner of one GL name. Its OffscreenContext must be current wherever one is destroyed.
template <auto Destroy>
class GlName {
 public:
  GlName() noexcept = default;
  explicit GlName(GLuint id) noexcept : id_{id} {}
  GlName(GlName&& other) noexcept : id_{std::exchange(other.id_, 0u)} {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlName() {
    if (id_ != 0) Destroy(id_);
  }
  GLuint id() const noexcept { return id_; }
  explicit operator bool() const noexcept { return id_ != 0; }

 private:
  GLuint id_ = 0;
};

inline void destroyTexture(GLuint id) {
  gl().DeleteTextures(1, &id);
}
inline void destroyFramebuffer(GLuint id) {
  gl().DeleteFramebuffers(1, &id);
}
inline void destroyBuffer(GLuint id) {
  gl().DeleteBuffers(1, &id);
}
inline void destroyVertexArray(GLuint id) {
  gl().DeleteVertexArrays(1, &id);
}
inline void destroyProgram(GLuint id) {
  gl().DeleteProgram(id);
}
inline void destroyShader(GLuint id) {
  gl().DeleteShader(id);
}

using Texture = GlName<destroyTexture>;
using Framebuffer = GlName<destroyFramebuffer>;
using Buffer = GlName<destroyBuffer>;
using VertexArray = GlName<destroyVertexArray>;
using Program = GlName<destroyProgram>;
using Shader = GlName<destroyShader>;

/// A texture of the given target with immutable state to come (storage is the caller's).
Texture makeTexture(GLenum target);
Framebuffer makeFramebuffer();
Buffer makeBuffer();
VertexArray makeVertexArray();

}  // namespace burin::node
