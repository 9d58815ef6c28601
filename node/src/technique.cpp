#include "burin/node/technique.hpp"

#include "burin/common/error.hpp"

namespace burin::node {

const char* name(Technique technique) {
  return technique == Technique::kSlices ? "slices" : "raycast";
}

const char* name(Precision precision) {
  if (precision == Precision::kHalf) return "half";
  return precision == Precision::kByte ? "byte" : "float";
}

void checkTechnique(const Scene& scene, Technique technique, Precision precision) {
  if (technique == Technique::kRaycast) {
    if (scene.quality.combine == Combine::kOver)
      fail(ExitCode::kUsage,
           "quality.combine: \"over\" is drawn by slices only (--technique slices)");
    if (scene.quality.normals == Normals::kQuantised)
      fail(ExitCode::kUsage,
           "quality.normals: \"quantised\" is drawn by slices only (--technique slices)");
    if (scene.quality.palettes == Palettes::kBefore)
      fail(ExitCode::kUsage,
           "quality.palettes: \"before\" is drawn by slices only (--technique slices)");
    if (precision != Precision::kFloat)
      fail(ExitCode::kUsage,
           "precision {} is one of slices' framebuffer (--technique slices), rays add up in float",
           name(precision));
  } else if (scene.quality.palettes == Palettes::kBefore && haloReach(scene) > 0) {
    fail(ExitCode::kUsage,
         "quality.palettes: \"before\" knows no halos, which are no voxel's own: expected "
         "\"after\"");
  } else if (hasSurfaces(scene)) {
    fail(
        ExitCode::kUsage,
        "layers: a surface (\"mode\": \"iso\") lies within slices, which draw media only: expected "
        "--technique raycast");
  } else if (scene.quality.maxError && precision != Precision::kFloat) {
    fail(ExitCode::kUsage,
         "quality.max_error bounds what steps are wrong by, not a framebuffer of precision {}: "
         "expected float, or quality.step_voxels",
         name(precision));
  } else if (scene.quality.maxError && scene.quality.preintegrated) {
    fail(ExitCode::kUsage,
         "quality.max_error with pre-integration is a matter of each ray, not of slices: expected "
         "--technique raycast, quality.preintegrated false, or quality.step_voxels");
  } else if (scene.quality.palettes == Palettes::kBefore && hasWidgets(scene)) {
    fail(ExitCode::kUsage,
         "quality.palettes: \"before\" looks values up, not the widgets of a two-dimensional "
         "transfer function: expected \"after\"");
  }
}

}  // namespace burin::node
