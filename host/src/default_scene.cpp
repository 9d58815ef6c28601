#include "burin/host/default_scene.hpp"

#include <algorithm>

#include "burin/common/error.hpp"
#include "first_view.hpp"
#include "materials.hpp"

namespace burin::host {

namespace {

/// Opacity units across the volume's diagonal.
constexpr double kUnitsAcross = 256;

double between(double low, double high, double t) {
  return low + t * (high - low);
}

/// Thin and dark at the boundary, firm and light at the top, as in a wash drawing.
TransferFunction risingOpacity(const Materials& materials) {
  TransferFunction function;
  const auto at = [&](double t) { return between(materials.outer, materials.top, t); };
  function.points = {{at(0), parseColour("#9c6b52"), 0},
                     {at(0.3), parseColour("#d8b491"), 0.15},
                     {at(1), parseColour("#fff6e6"), 0.7}};
  return function;
}

/// Firm light material in a skin so thin that it hides little: most opaque at its boundary, where
/// rays pass it quickly, and next to clear inside.
TransferFunction coreInSkin(const Materials& materials) {
  constexpr double kSkin = 0.05;
  constexpr double kFlesh = 0.006;
  const double outer = materials.outer;
  const double inner = *materials.inner;
  // Where little but the boundary is between the two, there is no most frequent value.
  const double flesh = std::max(materials.around, between(outer, inner, 0.4));
  TransferFunction function;
  function.points = {{outer, parseColour("#b5724c"), 0},
                     {between(outer, flesh, 0.35), parseColour("#d9996b"), kSkin},
                     {between(outer, flesh, 0.75), parseColour("#d9a27c"), kFlesh},
                     {between(flesh, inner, 0.7), parseColour("#d9a27c"), kFlesh},
                     {inner, parseColour("#e8d3b0"), 0.25},
                     {between(inner, materials.top, 0.4), parseColour("#fff6e6"), 0.7}};
  return function;
}

StyleSettings withDefaults(std::string_view name) {
  const StyleSpec* spec = findStyle(name);
  BURIN_CHECK(spec != nullptr);
  return defaultSettings(*spec);
}

/// Gradients of which the background's noise, with some margin, has no directions.
StyleSettings gradientsAbove(double noise) {
  constexpr double kMargin = 3;
  StyleSettings gradient = withDefaults("gradient");
  const StyleSpec& spec = *findStyle("gradient");
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const ParameterSpec& parameter = spec.parameters[i];
    if (parameter.name != "noise_floor") continue;
    const double usual = std::get<double>(parameter.defaultValue);
    gradient.values[i] = std::clamp(kMargin * noise, usual, parameter.maximum / 2);
  }
  return gradient;
}

}  // namespace

Scene makeDefaultScene(const VolumeChoice& choice, const VolumeFacts& facts,
                       const MaterialProfile& profile, const node::BlockRanges& blocks) {
  const Materials materials = findMaterials(profile);
  Scene scene;
  scene.volume = choice;
  Layer layer;
  layer.name = "volume";
  layer.transferFunction = materials.inner ? coreInSkin(materials) : risingOpacity(materials);
  layer.transferFunction.opacityUnitLength = 2 * facts.grid.boundingRadius() / kUnitsAcross;
  // The named style "illustration", without need of its file.
  layer.styles = {gradientsAbove(materials.noise), withDefaults("light"), withDefaults("tone"),
                  withDefaults("edges")};
  scene.layers = {layer};
  scene.camera = firstView(scene, facts, blocks);
  return scene;
}

}  // namespace burin::host
