#pragma once

#include <memory>

#include "gl_library_context.hpp"

namespace burin::node {

/// Mesa's off-screen rasteriser, opened with dlopen. The only class that knows OSMesa.
class OsMesaContext : public GlLibraryContext {
 public:
  /// Throws Error{kRank} naming the library and its package, or what was refused.
  OsMesaContext();
  ~OsMesaContext() override;

  bool makeCurrent() noexcept override;
  void release() noexcept override;
  Function function(const char* name) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
