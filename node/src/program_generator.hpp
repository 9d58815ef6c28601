#pragma once

#include <string>
#include <string_view>

#include "burin/common/scene.hpp"
#include "shader_source.hpp"

namespace burin::node {

/// What decides the text of a program beside the scene's layers.
struct ProgramOptions {
  bool invalidVoxels = false;
  bool countSamples = false;
  bool severalBricks = false;  ///< blended one behind the other into one frame
  bool isSteep = false;        ///< a transfer function is; for the adaptive march
};

/// The clip planes whose cuts some style shades.
std::vector<ClipPlane> cappedPlanes(const Scene& scene);

/// Whether segments are halved until they are right, instead of taken as they are.
bool isAdaptive(const Quality& quality);

/// The fused ray-cast program of a scene: all layers and passes, only what the scene uses. Two
/// scenes that differ in parameter values alone give the same text. Adding a style needs no change
/// here: its parameters come from styleTable(), its code from styles/<name>.glsl.
ShaderSource generateRaycastProgram(const Scene& scene, const ProgramOptions& options);

/// Of a projection, the scene's only layer.
ShaderSource generateProjectionProgram(const Scene& scene, const ProgramOptions& options);

/// The passes that a layer takes in the slices technique (Lum & Ma, Figure 10).
enum class LayerPass {
  kColour,  ///< pass I: the transfer function's colour and extinction under all styles but lines
  kLines,   ///< pass II: the styles that draw lines
};
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

/// Names of the uniforms that the generated program declares, in one place for both sides.
std::string parameterUniform(std::size_t layer, std::string_view style, std::string_view parameter);
std::string curveUniform(std::size_t layer, std::string_view style, std::string_view parameter);
/// vec4: the position that the style depends on is dot(xyz, p) + w, p in centred index space.
std::string placeUniform(std::size_t layer, std::string_view style);
/// struct HaloNeighbours of halo.glsl.
std::string haloUniform(std::size_t layer);
std::string magnitudeUniform(std::size_t layer);       ///< m = |gradient| * this
std::string isoColourUniform(std::size_t layer);       ///< vec4: a surface's colour and opacity
std::string isoLineOpacityUniform(std::size_t layer);  ///< of the lines on it
std::string widgetsUniform(std::size_t layer);         ///< vec4 array: widgetRows()
std::string maskUniform(std::size_t layer);  ///< number of a layer's mask, if it is bound to one

/// Those of a transfer function, by its number in transferFunctions().
std::string transferUniform(std::size_t function);       ///< sampler1DArray
std::string extinctionUniform(std::size_t function);     ///< sampler1D: TransferRows::extinction
std::string transferScaleUniform(std::size_t function);  ///< vec4: first value, bins per unit,
                                                         ///< bins, 1 / texels
std::string visibleBinsUniform(std::size_t function);    ///< vec2: nothing shows outside of it

}  // namespace burin::node
