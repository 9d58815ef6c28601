#pragma once

#include "burin/common/scene.hpp"
#include "layer_code.hpp"
#include "shader_source.hpp"

namespace burin::node {

/// What decides the text of a program beside the scene's layers.
struct ProgramOptions {
  bool invalidVoxels = false;
  bool countSamples = false;
  bool severalBricks = false;  ///< blended one behind the other into one frame
  bool isSteep = false;        ///< a transfer function is; for the adaptive march
};

/// The fused ray-cast program of a scene: all layers and passes, only what the scene uses. Two
/// scenes that differ in parameter values alone give the same text. Adding a style needs no change
/// here: its parameters come from styleTable(), its code from styles/<name>.glsl.
ShaderSource generateRaycastProgram(const Scene& scene, const ProgramOptions& options);

/// Of a projection, the scene's only layer.
ShaderSource generateProjectionProgram(const Scene& scene, const ProgramOptions& options);

/// Where slices are drawn.
enum class SliceTarget {
  kFrame,       ///< blended over the frame
  kLayerImage,  ///< into an image of their layer, which the resolve program reads
};

/// One pass of a scene's only layer on one slice. Styles of the other pass should not be in it.
ShaderSource generateSliceProgram(const Scene& scene, LayerPass pass, SliceTarget target,
                                  const ProgramOptions& options);
/// A slice from its layers' images.
ShaderSource generateResolveProgram(std::size_t layers);

/// The vertex program of all of them: one triangle that covers the target.
ShaderSource fullscreenVertexSource();

}  // namespace burin::node
