#pragma once

#include <map>
#include <optional>
#include <string>

#include "brick_renderer.hpp"
#include "frame_target.hpp"
#include "gl_program.hpp"
#include "program_uniforms.hpp"
#include "sample_counters.hpp"
#include "transfer_textures.hpp"

namespace burin::node {

/// Draws bricks with the fused ray-cast program, each blended behind the ones before it.
class Raycaster : public BrickRenderer {
 public:
  Raycaster(const Scene& scene, const LabelMasks& masks, const ProgramVolume& volume,
            const DrawOptions& options);

  void setScene(const Scene& scene, const LabelMasks& masks) override;
  std::size_t tableBytes() const override { return textures_.bytes(); }
  compositor::SubimageView<Rgba> draw(const Camera& camera, std::span<const Brick* const> bricks,
                                      RankStatistics& statistics, const PixelRoom& room,
                                      const StepMap* steps) override;

 private:
  Scene scene_;
  ProgramVolume volume_;
  DrawOptions options_;
  TransferTextures textures_;
  std::map<std::string, GlProgram> programs_;  ///< by their text
  GlProgram* program_ = nullptr;               ///< the scene's
  double mostSamplesOfSegment_ = 1;            ///< that it takes
  VertexArray vertexArray_;
  FrameTarget target_{GL_RGBA32F};
  std::optional<SampleCounters> counters_;
};

}  // namespace burin::node
