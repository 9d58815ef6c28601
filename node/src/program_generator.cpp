#include "program_generator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "burin/common/error.hpp"
#include "program_needs.hpp"

namespace burin::node {

namespace {

std::string defineClipPlanes(const Scene& scene) {
  const std::size_t planes = clipPlanes(scene).size();
  return planes > 0 ? fmt::format("#define CLIP_PLANES {}\n", planes) : "";
}

/// Everything before the main function.
std::string programHead(const Scene& scene, const ProgramOptions& options,
                        std::optional<LayerPass> pass) {
  std::string text = "#version 450 core\n";
  text += fmt::format("#define LIGHTS {}\n", scene.lights.size()) + defineClipPlanes(scene);
  const std::size_t caps = cappedPlanes(scene).size();
  if (caps > 0) text += fmt::format("#define CAPS {}\n", caps);
  if (options.invalidVoxels) text += "#define INVALID_VOXELS\n";
  if (options.countSamples) text += "#define COUNT_SAMPLES\n";
  if (options.severalBricks) text += "#define SEVERAL_BRICKS\n";
  if (haloReach(scene) > 0) text += "#define HALOS\n";
  if (labelsNeeded(scene)) text += "#define LABELS\n";
  if (isAdaptive(scene.quality)) text += "#define ADAPTIVE\n";
  const auto surfaces = std::ranges::count(scene.layers, LayerMode::kIso, &Layer::mode);
  if (surfaces > 0) text += fmt::format("#define SURFACES {}\n", surfaces);
  if (isAdaptive(scene.quality) && options.isSteep) text += "#define STEEP\n";
  if (scene.quality.preintegrated)
    text +=
        fmt::format("#define PREINTEGRATED\n#define LAYERS {}\n",
                    std::max(transferFunctions(scene).size(), std::size_t{1}));  // none: no array
  const bool palettesBefore = scene.quality.palettes == Palettes::kBefore;
  const bool atVoxels = palettesBefore || quantisesNormals(scene);
  if (atVoxels) text += "#define AT_VOXELS\n";
  if (palettesBefore) text += "#define PALETTES_BEFORE\n";
  for (const char* file : {"lattice.glsl", "ownership.glsl", "counters.glsl", "opacity.glsl",
                           "volume.glsl", "skip.glsl", "shading.glsl"})
    text += fmt::format("#include \"{}\"\n", file);
  if (atVoxels) text += "#include \"voxels.glsl\"\n";
  if (quantisesNormals(scene)) text += "#include \"direction_palette.glsl\"\n";
  if (palettesBefore) text += "#include \"palettes.glsl\"\n";
  if (caps > 0) text += "#include \"caps.glsl\"\n";
  if (laplacianNeeded(scene)) text += "#include \"laplacian.glsl\"\n";
  if (labelsNeeded(scene)) text += "#include \"labels.glsl\"\n";
  if (needsNeighbourhood(gradientOperatorsNeeded(scene)))
    text += "#include \"neighbourhood.glsl\"\n";
  if (scene.quality.preintegrated) text += "#include \"preintegration.glsl\"\n";
  if (hasWidgets(scene)) text += "#include \"widgets.glsl\"\n";
  text += layerCode(scene, pass);
  if (hasSurfaces(scene)) text += "#include \"exact.glsl\"\n#include \"surfaces.glsl\"\n";
  return text;
}

}  // namespace

ShaderSource generateRaycastProgram(const Scene& scene, const ProgramOptions& options) {
  return expandIncludes(programHead(scene, options, {}) + "#include \"raycast.glsl\"\n",
                        "raycast program");
}

ShaderSource generateProjectionProgram(const Scene& scene, const ProgramOptions& options) {
  BURIN_CHECK_EQ(scene.layers.size(), 1u);
  std::string text = "#version 450 core\n" + defineClipPlanes(scene);
  if (options.invalidVoxels) text += "#define INVALID_VOXELS\n";
  if (options.countSamples) text += "#define COUNT_SAMPLES\n";
  if (scene.layers.front().mode == LayerMode::kAverage) text += "#define MEAN\n";
  for (const char* file : {"lattice.glsl", "ownership.glsl", "counters.glsl", "volume.glsl",
                           "exact.glsl", "skip.glsl", "projection.glsl"})
    text += fmt::format("#include \"{}\"\n", file);
  return expandIncludes(text, "projection program");
}

ShaderSource generateSliceProgram(const Scene& scene, LayerPass pass, SliceTarget target,
                                  const ProgramOptions& options) {
  BURIN_CHECK_EQ(scene.layers.size(), 1u);
  std::string text = programHead(scene, options, pass);
  if (pass == LayerPass::kLines) text += "#define LINES_ONLY\n";
  if (target == SliceTarget::kLayerImage) text += "#define LAYER_IMAGE\n";
  return expandIncludes(text + "#include \"slice.glsl\"\n", "slice program");
}

ShaderSource generateResolveProgram(std::size_t layers) {
  return expandIncludes(fmt::format("#version 450 core\n#define LAYERS {}\n"
                                    "#include \"opacity.glsl\"\n#include \"resolve.glsl\"\n",
                                    layers),
                        "resolve program");
}

ShaderSource fullscreenVertexSource() {
  return expandIncludes("#version 450 core\n#include \"fullscreen.vert\"\n", "vertex program");
}

}  // namespace burin::node
