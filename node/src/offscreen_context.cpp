#include "burin/node/offscreen_context.hpp"

#include <cstdlib>

#include "burin/common/error.hpp"
#include "gl.hpp"
#include "osmesa_context.hpp"

namespace burin::node {
namespace {

GLADapiproc functionOf(void* backend, const char* name) {
  return static_cast<const OsMesaContext*>(backend)->function(name);
}

/// llvmpipe reads its thread count once, when its screen is made; a user's own setting stands.
void setRasteriserThreads(int threads) {
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

}  // namespace

struct OffscreenContext::State {
  OsMesaContext backend;
  GladGLContext gl{};
};

OffscreenContext::OffscreenContext(const ContextOptions& options) {
  setRasteriserThreads(options.threads);
  state_ = std::make_unique<State>();
  if (!state_->backend.makeCurrent())
    fail(ExitCode::kRank, "OSMesa could not make its context current");
  if (gladLoadGLContextUserPtr(&state_->gl, functionOf, &state_->backend) == 0)
    fail(ExitCode::kRank, "the OpenGL functions of OSMesa could not be loaded");
  setCurrentGl(&state_->gl);
}

OffscreenContext::~OffscreenContext() {
  forgetCurrentGl(&state_->gl);
}

void OffscreenContext::makeCurrent() noexcept {
  state_->backend.makeCurrent();
  setCurrentGl(&state_->gl);
}

const GladGLContext& OffscreenContext::gl() const {
  return state_->gl;
}

std::string OffscreenContext::description() const {
  const auto text = [this](GLenum name) {
    return reinterpret_cast<const char*>(state_->gl.GetString(name));
  };
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace burin::node
