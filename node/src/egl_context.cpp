#include "egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <mutex>
#include <string_view>

#include "shared_library.hpp"

namespace burin::node {
namespace {

constexpr const char* kLibrary = "libEGL";

SharedLibrary openLibrary() {
  // Kept for ever: drivers leave destructors of thread-local data behind.
  if (void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE))
    return SharedLibrary{handle};
  fail(ExitCode::kRank,
       "no off-screen OpenGL: libEGL.so.1 cannot be opened; install the packages libegl1 and "
       "libgl1-mesa-dri");
}

/// The functions of EGL 1.5 that are used, which libEGL exports by name.
struct Functions {
  explicit Functions(const SharedLibrary& library)
      : getPlatformDisplay{of<decltype(eglGetPlatformDisplay)>(library, "eglGetPlatformDisplay")},
        initialize{of<decltype(eglInitialize)>(library, "eglInitialize")},
        terminate{of<decltype(eglTerminate)>(library, "eglTerminate")},
        queryString{of<decltype(eglQueryString)>(library, "eglQueryString")},
        bindApi{of<decltype(eglBindAPI)>(library, "eglBindAPI")},
        createContext{of<decltype(eglCreateContext)>(library, "eglCreateContext")},
        destroyContext{of<decltype(eglDestroyContext)>(library, "eglDestroyContext")},
        makeCurrent{of<decltype(eglMakeCurrent)>(library, "eglMakeCurrent")},
        getProcAddress{of<decltype(eglGetProcAddress)>(library, "eglGetProcAddress")},
        getError{of<decltype(eglGetError)>(library, "eglGetError")} {}

  template <typename Function>
  static Function* of(const SharedLibrary& library, const char* name) {
    return resolve<Function>(library, kLibrary, name);
  }

  decltype(&eglGetPlatformDisplay) getPlatformDisplay;
  decltype(&eglInitialize) initialize;
  decltype(&eglTerminate) terminate;
  decltype(&eglQueryString) queryString;
  decltype(&eglBindAPI) bindApi;
  decltype(&eglCreateContext) createContext;
  decltype(&eglDestroyContext) destroyContext;
  decltype(&eglMakeCurrent) makeCurrent;
  decltype(&eglGetProcAddress) getProcAddress;
  decltype(&eglGetError) getError;
};

/// What all contexts of the process come out of. EGL has one display of a platform and ends it for
/// everybody, so it lives as long as any context.
class Display {
 public:
  static std::shared_ptr<Display> shared() {
    static std::mutex mutex;
    static std::weak_ptr<Display> last;
    const std::lock_guard lock{mutex};
    std::shared_ptr<Display> display = last.lock();
    if (!display) last = display = std::make_shared<Display>();
    return display;
  }

  Display() : library_{openLibrary()}, egl_{library_} {
    requireExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless");
    handle_ = egl_.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (handle_ == EGL_NO_DISPLAY || egl_.initialize(handle_, nullptr, nullptr) == EGL_FALSE)
      fail(ExitCode::kRank,
           "no off-screen OpenGL: EGL finds no driver (error {:#x}); install the package "
           "libgl1-mesa-dri",
           egl_.getError());
    try {
      requireExtension(handle_, "EGL_KHR_no_config_context");
      requireExtension(handle_, "EGL_KHR_surfaceless_context");
    } catch (...) {
      egl_.terminate(handle_);
      throw;
    }
  }
  ~Display() { egl_.terminate(handle_); }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  const Functions& egl() const { return egl_; }
  EGLDisplay handle() const { return handle_; }

 private:
  void requireExtension(EGLDisplay display, std::string_view name) const {
    const char* const text = egl_.queryString(display, EGL_EXTENSIONS);
    const std::string all = fmt::format(" {} ", text != nullptr ? text : "");
    if (all.find(fmt::format(" {} ", name)) == std::string::npos)
      fail(ExitCode::kRank, "no off-screen OpenGL: this EGL has no {}; Mesa's has", name);
  }

  SharedLibrary library_;
  Functions egl_;
  EGLDisplay handle_ = EGL_NO_DISPLAY;
};

EGLContext createContext(const Display& display) {
  constexpr std::array<EGLint, 7> kAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                              4,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              5,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_NONE};
  EGLContext context = EGL_NO_CONTEXT;
  if (display.egl().bindApi(EGL_OPENGL_API) == EGL_TRUE)
    context = display.egl().createContext(display.handle(), EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT,
                                          kAttributes.data());
  if (context == EGL_NO_CONTEXT)
    fail(ExitCode::kRank, "EGL refused an OpenGL 4.5 core context (error {:#x})",
         display.egl().getError());
  return context;
}

}  // namespace

struct EglContext::State {
  std::shared_ptr<Display> display = Display::shared();
  EGLContext context = createContext(*display);
};

EglContext::EglContext() : state_{std::make_unique<State>()} {}

EglContext::~EglContext() {
  state_->display->egl().destroyContext(state_->display->handle(), state_->context);
}

bool EglContext::makeCurrent() noexcept {
  return state_->display->egl().makeCurrent(state_->display->handle(), EGL_NO_SURFACE,
                                            EGL_NO_SURFACE, state_->context) == EGL_TRUE;
}

void EglContext::release() noexcept {
  state_->display->egl().makeCurrent(state_->display->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE,
                                     EGL_NO_CONTEXT);
}

EglContext::Function EglContext::function(const char* name) const {
  return state_->display->egl().getProcAddress(name);
}

}  // namespace burin::node
