#include "uniform_names.hpp"

#include <fmt/format.h>

namespace burin::node {

std::string parameterUniform(std::size_t layer, std::string_view style,
                             std::string_view parameter) {
  return fmt::format("layer{}_{}_{}", layer, style, parameter);
}
std::string curveUniform(std::size_t layer, std::string_view style, std::string_view parameter) {
  return parameterUniform(layer, style, parameter) + "_curve";
}
std::string placeUniform(std::size_t layer, std::string_view style) {
  return parameterUniform(layer, style, "place");
}
std::string haloUniform(std::size_t layer) {
  return parameterUniform(layer, "halo", "neighbours");
}
std::string transferUniform(std::size_t function) {
  return fmt::format("transfer{}", function);
}
std::string extinctionUniform(std::size_t function) {
  return fmt::format("extinctions{}", function);
}
std::string transferScaleUniform(std::size_t function) {
  return fmt::format("transferScale{}", function);
}
std::string visibleBinsUniform(std::size_t function) {
  return fmt::format("visibleBins{}", function);
}
std::string isoColourUniform(std::size_t layer) {
  return fmt::format("isoColour{}", layer);
}
std::string isoLineOpacityUniform(std::size_t layer) {
  return fmt::format("isoLineOpacity{}", layer);
}
std::string magnitudeUniform(std::size_t layer) {
  return fmt::format("magnitude{}", layer);
}
std::string widgetsUniform(std::size_t layer) {
  return fmt::format("widgets{}", layer);
}
std::string maskUniform(std::size_t layer) {
  return fmt::format("mask{}", layer);
}

}  // namespace burin::node
