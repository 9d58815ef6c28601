#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/transfer_function.hpp"

namespace burin {

/// How another program blends between two colours (sRGB values in [0, 1]). Names are VTK's.
enum class ColourSpace {
  kRgb,        ///< the values as they are
  kHsv,        ///< hue, saturation, value
  kLab,        ///< CIE L*a*b*, D65
  kDiverging,  ///< through white where hues differ much (Moreland 2009)
  kStep,       ///< not at all: an interval has its upper end's colour
};

/// `a` to `b` by t in [0, 1]. Moreland, "Diverging Color Maps for Scientific Visualization", ISVC
/// 2009, with the constants of VTK (vtkColorTransferFunction), which ParaView draws with. With
/// `hueWraps`, HSV goes the shorter way around the circle. Values beyond [0, 1] are scaled back.
glm::dvec3 blendColours(ColourSpace space, bool hueWraps, const glm::dvec3& a, const glm::dvec3& b,
                        double t);

/// The share of the upper node at t in [0, 1] between two nodes of a VTK function: `midpoint` is
/// where it is ½, `sharpness` takes it from linear (0) to a step (1).
double nodeWeight(double t, double midpoint, double sharpness);

/// Midpoint and sharpness are those of the interval above the node.
struct ColourNode {
  double x = 0;
  glm::dvec3 colour{0};  ///< sRGB in [0, 1]
  double midpoint = 0.5;
  double sharpness = 0;
};
struct OpacityNode {
  double x = 0;
  double opacity = 0;
  double midpoint = 0.5;
  double sharpness = 0;
};

/// Colour and opacity by value as another program has them. Nodes rise in x; of two at one x the
/// later holds there.
struct ColourMap {
  std::string name;
  ColourSpace space = ColourSpace::kRgb;
  bool hueWraps = false;
  std::vector<ColourNode> colours;     ///< at least one
  std::vector<OpacityNode> opacities;  ///< none: opacity rises from 0 to 1 over the colours
  std::optional<double> unitLength;    ///< world units that opacities refer to
  bool hasGradientOpacity = false;     ///< which does not become part of a transfer function

  /// Ends hold outside.
  glm::dvec3 colourAt(double x) const;
  double opacityAt(double x) const;
};

/// Largest differences of transferFunctionFrom to the map it comes from, between its nodes as well.
inline constexpr double kColourMapCodes = 1.25;  ///< of a channel, in 255ths of sRGB
inline constexpr double kColourMapOpacity = 0x1p-9;

/// The map in points that are linear in linear light, as many as the tolerances take. With `range`,
/// the map's first and last colour come to lie at its ends.
TransferFunction transferFunctionFrom(const ColourMap& map,
                                      const std::optional<glm::dvec2>& range = {});

/// Reads ParaView's JSON (`map`: the name of one of several; "" the first), 3D Slicer's volume
/// properties, .vp and .vp.json; notes if one has opacity by gradient. Throws Error{kUsage} with
/// the place in the file.
ColourMap readColourMap(const std::filesystem::path& file, std::string_view map = {});

/// As ParaView imports it: one map in its RGB space, with opacities. Throws Error{kUsage} for a
/// two-dimensional function.
std::string paraviewJson(const TransferFunction& function, std::string_view name);

}  // namespace burin
