#include "gl.hpp"

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

thread_local const GladGLContext* currentGl = nullptr;

const char* errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "unknown error";
  }
}

}  // namespace

const GladGLContext& gl() {
  BURIN_CHECK(currentGl != nullptr);
  return *currentGl;
}

void setCurrentGl(const GladGLContext* context) noexcept {
  currentGl = context;
}

void forgetCurrentGl(const GladGLContext* context) noexcept {
  if (currentGl == context) currentGl = nullptr;
}

void checkGl(std::string_view what) {
  const GLenum error = gl().GetError();
  if (error != GL_NO_ERROR) fail(ExitCode::kRank, "{}: OpenGL: {}", what, errorName(error));
}

Texture makeTexture(GLenum target) {
  GLuint id = 0;
  gl().CreateTextures(target, 1, &id);
  return Texture{id};
}

Framebuffer makeFramebuffer() {
  GLuint id = 0;
  gl().CreateFramebuffers(1, &id);
  return Framebuffer{id};
}

Buffer makeBuffer() {
  GLuint id = 0;
  gl().CreateBuffers(1, &id);
  return Buffer{id};
}

VertexArray makeVertexArray() {
  GLuint id = 0;
  gl().CreateVertexArrays(1, &id);
  return VertexArray{id};
}

}  // namespace burin::node
