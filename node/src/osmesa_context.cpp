#include "osmesa_context.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <type_traits>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

struct CloseLibrary {
  void operator()(void* handle) const noexcept { dlclose(handle); }
};
using Library = std::unique_ptr<void, CloseLibrary>;

Library openLibrary() {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return Library{handle};
  }
  fail(ExitCode::kRank,
       "no off-screen OpenGL: libOSMesa.so.8 cannot be opened; install the package libosmesa6");
}

template <typename Function>
Function* resolve(const Library& library, const char* name) {
  void* symbol = dlsym(library.get(), name);
  if (symbol == nullptr) fail(ExitCode::kRank, "libOSMesa has no function {}", name);
  return reinterpret_cast<Function*>(symbol);
}

struct DestroyContext {
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  void operator()(OSMesaContext context) const noexcept { destroy(context); }
};
using ContextHandle = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, DestroyContext>;

ContextHandle createContext(const Library& library) {
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
  const auto create =
      resolve<decltype(OSMesaCreateContextAttribs)>(library, "OSMesaCreateContextAttribs");
  ContextHandle context{create(kAttributes.data(), nullptr),
                        {resolve<decltype(OSMesaDestroyContext)>(library, "OSMesaDestroyContext")}};
  if (!context) fail(ExitCode::kRank, "OSMesa refused an OpenGL 4.5 core context");
  return context;
}

}  // namespace

struct OsMesaContext::State {
  Library library;  // first: closed after everything that came out of it
  ContextHandle context;
  std::array<unsigned char, 4> defaultBuffer{};  // OSMesa wants one; we draw into our own targets
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) getFunction = nullptr;
};

OsMesaContext::OsMesaContext() : state_{std::make_unique<State>()} {
  State& state = *state_;
  state.library = openLibrary();
  state.context = createContext(state.library);
  state.makeCurrent = resolve<decltype(OSMesaMakeCurrent)>(state.library, "OSMesaMakeCurrent");
  state.getFunction =
      resolve<decltype(OSMesaGetProcAddress)>(state.library, "OSMesaGetProcAddress");
}

OsMesaContext::~OsMesaContext() = default;

bool OsMesaContext::makeCurrent() noexcept {
  return state_->makeCurrent(state_->context.get(), state_->defaultBuffer.data(), GL_UNSIGNED_BYTE,
                             1, 1) != GL_FALSE;
}

OsMesaContext::Function OsMesaContext::function(const char* name) const {
  return state_->getFunction(name);
}

}  // namespace burin::node
