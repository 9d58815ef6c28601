#pragma once

#include <map>
#include <optional>
#include <string>

#include "brick_renderer.hpp"
#include "burin/common/footprint.hpp"
#include "burin/common/sample_lattice.hpp"
#include "burin/node/technique.hpp"
#include "frame_target.hpp"
#include "gl_program.hpp"
#include "layer_images.hpp"
#include "program_generator.hpp"
#include "program_uniforms.hpp"
#include "sample_counters.hpp"
#include "transfer_textures.hpp"

namespace burin::node {

/// Draws bricks slice by slice, back to front: the samples between two lattice planes at a time, in
/// one draw for every layer and pass, as Lum & Ma's hardware did ("Interactive NPR", section 3.1).
///
/// Under Combine::kSum a layer's passes meet in an image of that layer, and a resolve draw sums the
/// layers and blends the slice over the frame: exactly what the fused program does at a sample.
/// Under Combine::kOver, and where there is one layer with one pass, every draw is blended over the
/// frame at once.
class Slicer : public BrickRenderer {
 public:
  Slicer(const Scene& scene, const LabelMasks& masks, const ProgramVolume& volume,
         const DrawOptions& options, Precision precision);

  void setScene(const Scene& scene, const LabelMasks& masks) override;
  std::size_t tableBytes() const override { return textures_.bytes(); }
  compositor::SubimageView<Rgba> draw(const Camera& camera, std::span<const Brick* const> bricks,
                                      RankStatistics& statistics, const PixelRoom& room,
                                      const StepMap* steps) override;

 private:
  /// One draw of every slice.
  struct Pass {
    std::size_t layer;
    LayerPass kind;
    GlProgram* program;
  };
  /// What is drawn of a brick at one step.
  struct Slices {
    IndexBox cells;
    SampleLattice lattice;
    PixelRect pixels;
  };

  Pass makePass(const Scene& scene, std::size_t layer, LayerPass kind, SliceTarget target);
  GlProgram* program(const std::string& key, const ShaderSource& source);
  void drawSlices(const Camera& camera, const Slices& slices, RankStatistics& statistics);
  void drawSlice(int slice);
  void drawToLayerImage(const Pass& pass);
  void drawOverFrame(const GlProgram& program);
  void count(std::int64_t fragments, RankStatistics& statistics);

  Scene scene_;
  ProgramVolume volume_;
  DrawOptions options_;
  TransferTextures textures_;
  std::map<std::string, GlProgram> programs_;  ///< by layer and text: each has its uniforms
  std::vector<Pass> passes_;
  GlProgram* resolve_ = nullptr;  ///< the scene's; nullptr: passes are drawn over the frame
  VertexArray vertexArray_;
  FrameTarget target_;
  LayerImages images_;
  std::optional<SampleCounters> counters_;
  std::int64_t counted_ = 0;  ///< at most, since the counters began
};

}  // namespace burin::node
