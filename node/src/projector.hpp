#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "brick_renderer.hpp"
#include "burin/compositor/largest_value.hpp"
#include "burin/compositor/weighted_sum.hpp"
#include "frame_target.hpp"
#include "gl_program.hpp"
#include "program_uniforms.hpp"
#include "sample_counters.hpp"

namespace burin::node {

/// Draws a projection, the only layer of its scene: one number for each ray, in stored values. Its
/// OffscreenContext must be current.
class Projector {
 public:
  Projector(const Scene& scene, const ProgramVolume& volume, const DrawOptions& options);

  /// Draws this scene from now on (same volume). If it throws, the scene before stays.
  void setScene(const Scene& scene);

  /// Of a layer of mode kMip: the largest value at a sample of the bricks, in any order.
  compositor::Subimage<compositor::LargestValuePixel> largest(const Camera& camera,
                                                              std::span<const Brick* const> bricks,
                                                              RankStatistics& statistics);
  /// Of a layer of mode kAverage: values at the samples times their segments' lengths, in planes.
  compositor::Subimage<compositor::WeightedSumPixel> sums(const Camera& camera,
                                                          std::span<const Brick* const> bricks,
                                                          RankStatistics& statistics);

 private:
  template <typename Pixel>
  compositor::Subimage<Pixel> draw(const Camera& camera, std::span<const Brick* const> bricks,
                                   RankStatistics& statistics);

  Scene scene_;
  ProgramVolume volume_;
  DrawOptions options_;
  std::map<std::string, GlProgram> programs_;  ///< by their text
  GlProgram* program_ = nullptr;               ///< the scene's
  VertexArray vertexArray_;
  FrameTarget target_{GL_RG32F};
  std::optional<SampleCounters> counters_;
};

}  // namespace burin::node
