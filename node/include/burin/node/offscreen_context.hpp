#pragma once

#include <memory>
#include <string>

struct GladGLContext;

namespace burin::node {

struct ContextOptions {
  int threads = 0;  ///< rasteriser threads; 0: leave it to the environment (LP_NUM_THREADS)
};

/// An OpenGL 4.5 core context that needs no display and no GPU. The library behind it is opened at
/// run time, so one binary runs where it is missing until a context is asked for. Current on the
/// thread that made it until another is made current; GL names must not outlive it. Another
/// headless backend is another source file beside offscreen_context.cpp.
class OffscreenContext {
 public:
  /// Throws Error{kRank} naming the library that is missing and the package that has it, or what
  /// the driver refused.
  explicit OffscreenContext(const ContextOptions& options);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Makes it this thread's context again: before drawing and before its GL names are destroyed, in
  /// a process that has several. A refusal shows in the next OpenGL call's error.
  void makeCurrent() noexcept;

  const GladGLContext& gl() const;
  /// "renderer, version" as the driver says them.
  std::string description() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
