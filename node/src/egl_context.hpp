#pragma once

#include <memory>

#include "gl_library_context.hpp"

namespace burin::node {

/// A context of EGL without surfaces (EGL_MESA_platform_surfaceless), opened with dlopen: a
/// graphics card if Mesa finds one, else llvmpipe. The only class that knows EGL.
class EglContext : public GlLibraryContext {
 public:
  /// Throws Error{kRank} naming the library and its package, or what was refused.
  EglContext();
  ~EglContext() override;

  bool makeCurrent() noexcept override;
  void release() noexcept override;
  Function function(const char* name) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
