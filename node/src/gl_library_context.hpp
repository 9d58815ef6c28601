#pragma once

namespace burin::node {

/// A way to an off-screen OpenGL 4.5 core context: one class for each library that makes them.
class GlLibraryContext {
 public:
  using Function = void (*)();

  virtual ~GlLibraryContext() = default;
  /// Makes it this thread's context; whether that was possible.
  virtual bool makeCurrent() noexcept = 0;
  /// If it is this thread's context, the thread has none afterwards.
  virtual void release() noexcept = 0;
  /// Address of an OpenGL function; nullptr if there is none.
  virtual Function function(const char* name) const = 0;
};

}  // namespace burin::node
