#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "brick.hpp"
#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/common/statistics.hpp"
#include "burin/compositor/subimage.hpp"
#include "burin/node/step_map.hpp"
#include "gl_program.hpp"
#include "program_generator.hpp"

namespace burin::node {

struct RaycastOptions {
  bool skip = true;
  bool countSamples = false;
  bool severalBricks = false;  ///< draw() gets more than one: those behind need what is in front
};

/// Draws bricks with the fused ray-cast program. Holds the program of the current scene, its
/// transfer-function textures and the float target. Its OffscreenContext must be current.
class Raycaster {
 public:
  /// `gradientScales`: world gradient magnitude (data units) that counts as m = 1, by percentile
  /// and by maximum; 0 where the volume has no gradients.
  struct GradientScales {
    double percentile = 0;
    double maximum = 0;
  };

  Raycaster(const Scene& scene, const VolumeGrid& grid, const ValueScale& scale,
            const GradientScales& gradients, const RaycastOptions& options);

  /// Draws this scene from now on (same volume). Programs are kept: going back to a set of styles
  /// compiles nothing. If it throws, the scene before stays.
  void setScene(const Scene& scene);

  /// Draws `bricks`, given front to back, blending each behind the ones before it. Adds the sample
  /// counters to `statistics` if they are counted. `room(n)`: where n pixels go. `steps` replaces
  /// the scene's step if given.
  compositor::SubimageView<Rgba> draw(const Camera& camera, std::span<const Brick* const> bricks,
                                      RankStatistics& statistics,
                                      const std::function<std::span<Rgba>(std::size_t)>& room,
                                      const StepMap* steps);

 private:
  /// World gradient magnitude that counts as 1 in the program before a layer's own scale.
  double gradientUnit() const;
  void setSceneUniforms();
  void setStyleUniforms(std::size_t layer);
  void setViewUniforms(const Camera& camera);
  void setStepUniforms(const Camera& camera, double stepVoxels);
  void setBrickUniforms(const Brick& brick);
  void resizeTarget(ImageSize size);
  void drawPixels(const PixelRect& pixels, double stepVoxels, RankStatistics& statistics);
  void addCounters(RankStatistics& statistics);

  Scene scene_;
  VolumeGrid grid_;
  ValueScale scale_;
  GradientScales gradients_;
  RaycastOptions options_;
  std::vector<TransferTable> tables_;
  std::vector<Texture> transferTextures_;
  std::map<std::string, GlProgram> programs_;  ///< by their text
  GlProgram* program_ = nullptr;               ///< the scene's
  VertexArray vertexArray_;
  Texture target_;
  Framebuffer framebuffer_;
  ImageSize targetSize_;
  Buffer counters_;
};

}  // namespace burin::node
