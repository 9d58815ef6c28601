#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace burin::node {

/// Names of the uniforms that generated programs declare, in one place for both sides.
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
