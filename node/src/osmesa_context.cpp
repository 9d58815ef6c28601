#include "osmesa_context.hpp"

#include <GL/osmesa.h>

#include <array>
#include <type_traits>

#include "shared_library.hpp"

namespace burin::node {
namespace {

constexpr const char* kLibrary = "libOSMesa";

SharedLibrary openLibrary() {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary{handle};
  }
  fail(ExitCode::kRank,
       "no off-screen OpenGL: libOSMesa.so.8 cannot be opened; install the package libosmesa6, or "
       "try --gl egl");
}

struct DestroyContext {
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  void operator()(OSMesaContext context) const noexcept { destroy(context); }
};
using ContextHandle = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, DestroyContext>;

ContextHandle createContext(const SharedLibrary& library) {
  constexpr std::array kAttributes{OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_DEPTH_BITS,
                                   0,
                                   OSMESA_STENCIL_BITS,
                                   0,
                                   OSMESA_ACCUM_BITS,
                                   0,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   4,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   5,
                                   0};
  const auto create = resolve<decltype(OSMesaCreateContextAttribs)>(library, kLibrary,
                                                                    "OSMesaCreateContextAttribs");
  const auto destroy =
      resolve<decltype(OSMesaDestroyContext)>(library, kLibrary, "OSMesaDestroyContext");
  ContextHandle context{create(kAttributes.data(), nullptr), {destroy}};
  if (!context) fail(ExitCode::kRank, "OSMesa refused an OpenGL 4.5 core context");
  return context;
}

}  // namespace

struct OsMesaContext::State {
  SharedLibrary library;  // first: closed after everything that came out of it
  ContextHandle context;
  std::array<unsigned char, 4> defaultBuffer{};  // OSMesa wants one; we draw into our own targets
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) getFunction = nullptr;
};

OsMesaContext::OsMesaContext() : state_{std::make_unique<State>()} {
  State& state = *state_;
  state.library = openLibrary();
  state.context = createContext(state.library);
  state.makeCurrent =
      resolve<decltype(OSMesaMakeCurrent)>(state.library, kLibrary, "OSMesaMakeCurrent");
  state.getFunction =
      resolve<decltype(OSMesaGetProcAddress)>(state.library, kLibrary, "OSMesaGetProcAddress");
}

OsMesaContext::~OsMesaContext() = default;

bool OsMesaContext::makeCurrent() noexcept {
  return state_->makeCurrent(state_->context.get(), state_->defaultBuffer.data(), GL_UNSIGNED_BYTE,
                             1, 1) != GL_FALSE;
}

void OsMesaContext::release() noexcept {
  state_->makeCurrent(nullptr, nullptr, 0, 0, 0);
}

OsMesaContext::Function OsMesaContext::function(const char* name) const {
  return state_->getFunction(name);
}

}  // namespace burin::node
