#include "burin/node/offscreen_context.hpp"

#include <cstdlib>

#include "burin/common/error.hpp"
#include "egl_context.hpp"
#include "gl.hpp"
#include "osmesa_context.hpp"

namespace burin::node {
namespace {

GLADapiproc functionOf(void* backend, const char* name) {
  return static_cast<const GlLibraryContext*>(backend)->function(name);
}

std::unique_ptr<GlLibraryContext> makeBackend(GlBackend backend) {
  if (backend == GlBackend::kEgl) return std::make_unique<EglContext>();
  return std::make_unique<OsMesaContext>();
}

/// llvmpipe reads its thread count once, when its screen is made; a user's own setting stands.
void setRasteriserThreads(int threads) {
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

/// Of this thread. Mesa's libraries share what they call the current context, but each remembers
/// its own: one that thinks that its context is current still does nothing when asked for it again.
/// So whoever comes next makes the one before let go.
thread_local GlLibraryContext* currentContext = nullptr;

bool bind(GlLibraryContext& next) noexcept {
  if (currentContext != nullptr && currentContext != &next) currentContext->release();
  currentContext = &next;
  return next.makeCurrent();
}

}  // namespace

struct OffscreenContext::State {
  explicit State(GlBackend library) : backend{makeBackend(library)} {}
  ~State() {
    if (currentContext != backend.get()) return;
    backend->release();
    currentContext = nullptr;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::unique_ptr<GlLibraryContext> backend;
  GladGLContext gl{};
};

OffscreenContext::OffscreenContext(const ContextOptions& options) {
  setRasteriserThreads(options.threads);
  state_ = std::make_unique<State>(options.backend);
  if (!bind(*state_->backend))
    fail(ExitCode::kRank, "{} could not make its context current", name(options.backend));
  if (gladLoadGLContextUserPtr(&state_->gl, functionOf, state_->backend.get()) == 0)
    fail(ExitCode::kRank, "the OpenGL functions of {} could not be loaded", name(options.backend));
  setCurrentGl(&state_->gl);
}

OffscreenContext::~OffscreenContext() {
  forgetCurrentGl(&state_->gl);
}

void OffscreenContext::makeCurrent() noexcept {
  bind(*state_->backend);
  setCurrentGl(&state_->gl);
}

const GladGLContext& OffscreenContext::gl() const {
  return state_->gl;
}

GlDescription OffscreenContext::description() const {
  const auto text = [this](GLenum name) {
    return std::string{reinterpret_cast<const char*>(state_->gl.GetString(name))};
  };
  const auto number = [this](GLenum name) {
    GLint value = 0;
    state_->gl.GetIntegerv(name, &value);
    return value;
  };
  return {text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION), number(GL_MAX_3D_TEXTURE_SIZE),
          number(GL_MAX_TEXTURE_SIZE)};
}

const char* name(GlBackend backend) {
  return backend == GlBackend::kEgl ? "EGL" : "OSMesa";
}

}  // namespace burin::node
