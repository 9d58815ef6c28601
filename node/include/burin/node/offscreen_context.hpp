#pragma once

#include <memory>
#include <string>

struct GladGLContext;

namespace burin::node {

/// Which library makes the context.
enum class GlBackend {
  kOsMesa,  ///< Mesa's rasteriser in memory
  kEgl,     ///< EGL without surfaces: a graphics card if there is one, else the same rasteriser
};
/// "OSMesa", "EGL"
const char* name(GlBackend backend);

struct ContextOptions {
  int threads = 0;  ///< rasteriser threads; 0: leave it to the environment (LP_NUM_THREADS)
  GlBackend backend = GlBackend::kOsMesa;
};

/// What a driver says of itself.
struct GlDescription {
  std::string vendor, renderer, version;
  int largest3dTexture = 0;  ///< voxels along each axis
  int largestTexture = 0;    ///< pixels along each axis
};

/// An OpenGL 4.5 core context that needs no display and no GPU. The library behind it is opened at
/// run time, so one binary runs where it is missing until a context is asked for. Current on the
/// thread that made it until another is made current, whichever library that is of; GL names must
/// not outlive it.
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
  GlDescription description() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
