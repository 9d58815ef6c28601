#include "burin/host/default_scene.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "coarse_look.hpp"
#include "first_view.hpp"
#include "material_layout.hpp"
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

/// The same of what is darker than its surroundings.
TransferFunction fallingOpacity(const Materials& materials) {
  TransferFunction function;
  const auto at = [&](double t) { return between(materials.outer, materials.bottom, t); };
  function.points = {{at(1), parseColour("#fff6e6"), 0.7},
                     {at(0.3), parseColour("#d8b491"), 0.15},
                     {at(0), parseColour("#9c6b52"), 0}};
  return function;
}

/// Firm light material in a skin so thin that it hides little: most opaque at its boundary, where
/// rays pass it quickly, and next to clear inside. The skin is firmer where the material lies
/// `bare` (bareShare): it has less to hide there, and more to show beside it.
TransferFunction coreInSkin(const Materials& materials, double bare) {
  constexpr double kEnclosed = 0.7;
  const double firm = std::max(0.0, (bare - kEnclosed) / (1 - kEnclosed));
  const double skin = between(0.05, 0.2, firm);
  const double inside = between(0.006, 0.03, firm);
  const double outer = materials.outer;
  const double inner = *materials.inner;
  // Where little but the boundary is between the two, there is no most frequent value.
  const double flesh = std::max(materials.around, between(outer, inner, 0.4));
  TransferFunction function;
  function.points = {{outer, parseColour("#b5724c"), 0},
                     {between(outer, flesh, 0.35), parseColour("#d9996b"), skin},
                     {between(outer, flesh, 0.75), parseColour("#d9a27c"), inside},
                     {between(flesh, inner, 0.7), parseColour("#d9a27c"), inside},
                     {inner, parseColour("#e8d3b0"), 0.25},
                     {between(inner, materials.top, 0.4), parseColour("#fff6e6"), 0.7}};
  return function;
}

TransferFunction transferFunctionFor(const Materials& materials, Surroundings surroundings,
                                     const node::BlockRanges& blocks) {
  if (surroundings == Surroundings::kBright) return fallingOpacity(materials);
  if (!materials.inner) return risingOpacity(materials);
  return coreInSkin(materials, bareShare(blocks, materials.outer, *materials.inner));
}

/// The largest factor from 2^-4 to 2^4 for which something holds that holds for all smaller ones;
/// the smallest if there is none.
template <typename Holds>
double largestFactor(Holds&& holds) {
  constexpr int kSteps = 8;
  double low = -4, high = 4;
  if (holds(std::exp2(high))) return std::exp2(high);
  for (int i = 0; i < kSteps; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(std::exp2(middle)) ? low : high) = middle;
  }
  return std::exp2(low);
}

/// What a skin's extinctions are multiplied with, so that it is seen where it is alone and leaves
/// most of what lies within: as they are if that is so.
double balance(const CoarseLook& look) {
  constexpr double kSeen = 0.3;
  constexpr double kLeft = 0.6;
  const auto leavesCore = [&](double factor) { return look.withSkin(factor).core > kLeft; };
  const Visibility now = look.withSkin(1);
  if (now.core <= kLeft) return largestFactor(leavesCore);
  if (now.skin >= kSeen) return 1;
  return std::max(1.0, largestFactor([&](double factor) {
                    const Visibility then = look.withSkin(factor);
                    return then.skin < kSeen && then.core > kLeft;
                  }));
}

/// Extinctions of values below `end` times `factor`.
void multiplyBelow(TransferFunction& function, double end, double factor) {
  for (TransferPoint& point : function.points)
    if (point.value < end) point.opacity = -std::expm1(factor * std::log1p(-point.opacity));
}

StyleSettings withDefaults(std::string_view name) {
  const StyleSpec* spec = findStyle(name);
  BURIN_CHECK(spec != nullptr);
  return defaultSettings(*spec);
}

/// Gradients of which a dark background's noise, with some margin, has no directions; away from
/// what shows, which is dense unless its surroundings are bright.
StyleSettings gradientsFor(const Materials& materials, Surroundings surroundings) {
  constexpr double kMargin = 3;
  const bool isBright = surroundings == Surroundings::kBright;
  StyleSettings gradient = withDefaults("gradient");
  const StyleSpec& spec = *findStyle("gradient");
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const ParameterSpec& parameter = spec.parameters[i];
    if (parameter.name == "noise_floor" && !isBright) {
      const double usual = std::get<double>(parameter.defaultValue);
      gradient.values[i] = std::clamp(kMargin * materials.noise, usual, parameter.maximum / 2);
    }
    if (parameter.name == "normal" && isBright) gradient.values[i] = std::string{"inward"};
  }
  return gradient;
}

}  // namespace

Scene makeDefaultScene(const VolumeChoice& choice, const VolumeFacts& facts,
                       const MaterialProfile& profile, const node::BlockRanges& blocks) {
  Materials materials = findMaterials(profile);
  Surroundings surroundings = findSurroundings(blocks, materials.outer);
  const std::optional<double> faint = faintBoundary(blocks, materials.outer);
  if (faint && (surroundings == Surroundings::kDark ||
                findSurroundings(blocks, *faint) == Surroundings::kDark)) {
    materials = withFaint(materials, *faint, profile.histogram);
    surroundings = Surroundings::kDark;
  }
  Scene scene;
  scene.volume = choice;
  Layer layer;
  layer.name = "volume";
  layer.transferFunction = transferFunctionFor(materials, surroundings, blocks);
  layer.transferFunction.opacityUnitLength = 2 * facts.grid.boundingRadius() / kUnitsAcross;
  // The named style "illustration", without need of its file.
  layer.styles = {gradientsFor(materials, surroundings), withDefaults("light"),
                  withDefaults("tone"), withDefaults("edges")};
  // What fills its box would show nothing but the box: only its boundaries are left.
  if (surroundings == Surroundings::kNone)
    layer.styles.insert(layer.styles.begin() + 1, withDefaults("surface"));
  scene.layers = {layer};
  scene.camera = firstView(scene, facts, blocks);
  if (materials.inner && surroundings == Surroundings::kDark) {
    TransferFunction& function = scene.layers.front().transferFunction;
    const glm::dvec3 forward = resolveCamera(scene, facts).forward;
    multiplyBelow(function, *materials.inner,
                  balance(CoarseLook{facts.grid, blocks, function, *materials.inner, forward}));
  }
  return scene;
}

}  // namespace burin::host
