#include "burin/host/default_scene.hpp"

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::host {

namespace {

/// Opacity units across the volume's diagonal.
constexpr double kUnitsAcross = 256;

/// Thin and dark at the threshold, firm and light at the top, as in a wash drawing.
TransferFunction risingOpacity(const Histogram& histogram) {
  const double threshold = otsuThreshold(histogram);
  // One bin at least: a curve needs its points apart, and floats can be told apart no finer.
  const double top =
      std::max(quantileAbove(histogram, threshold, 0.99), threshold + histogram.binWidth);
  const auto between = [&](double t) { return threshold + t * (top - threshold); };
  TransferFunction function;
  function.points = {{between(0), parseColour("#9c6b52"), 0},
                     {between(0.3), parseColour("#d8b491"), 0.15},
                     {between(1), parseColour("#fff6e6"), 0.7}};
  return function;
}

StyleSettings withDefaults(std::string_view name) {
  const StyleSpec* spec = findStyle(name);
  BURIN_CHECK(spec != nullptr);
  return defaultSettings(*spec);
}

}  // namespace

Scene makeDefaultScene(const VolumeChoice& choice, const VolumeFacts& facts,
                       const Histogram& histogram) {
  Scene scene;
  scene.volume = choice;
  Layer layer;
  layer.name = "volume";
  layer.transferFunction = risingOpacity(histogram);
  layer.transferFunction.opacityUnitLength = 2 * facts.grid.boundingRadius() / kUnitsAcross;
  layer.styles = {withDefaults("light"), withDefaults("tone"), withDefaults("edges")};
  scene.layers = {layer};
  return scene;
}

}  // namespace burin::host
