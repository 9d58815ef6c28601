#pragma once

#include <memory>

namespace burin::node {

/// Mesa's off-screen rasteriser, opened with dlopen: a core 4.5 context. The only class that knows
/// OSMesa.
class OsMesaContext {
 public:
  using Function = void (*)();

  /// Throws Error{kRank} naming the library and its package, or what was refused.
  OsMesaContext();
  ~OsMesaContext();

  /// Makes it this thread's context; whether that was possible.
  bool makeCurrent() noexcept;

  /// Address of an OpenGL function; nullptr if there is none.
  Function function(const char* name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
