#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "burin/common/colour.hpp"

namespace burin {

/// Piecewise linear curve through (x, y) points sorted by x (strictly), end values hold outside.
struct Curve {
  std::vector<glm::dvec2> points;
  double at(double x) const;
  friend bool operator==(const Curve&, const Curve&) = default;
};

struct ColourPoint {
  double x = 0;
  Colour colour;
  friend bool operator==(const ColourPoint&, const ColourPoint&) = default;
};

/// Colours over x, piecewise linear in linear RGB through points sorted by x (strictly); the end
/// colours hold outside.
struct ColourCurve {
  std::vector<ColourPoint> points;
  glm::dvec3 at(double x) const;  ///< linear RGB
  friend bool operator==(const ColourCurve&, const ColourCurve&) = default;
};

/// A number, a colour, one word of a list, a curve, a curve of colours, or a direction (world
/// space, not zero, need not be unit).
using ParameterValue = std::variant<double, Colour, std::string, Curve, ColourCurve, glm::dvec3>;

/// One style parameter: the only place where its name, range, default, unit and help stand. The
/// scene parser, schema.json, --help and the GUI's panels are generated from it.
struct ParameterSpec {
  std::string_view name;  ///< snake_case, as in the scene file
  std::string_view help;  ///< one line
  ParameterValue defaultValue;
  double minimum = 0;  ///< number: the value's range; curve: the range of y
  double maximum = 1;
  std::string_view unit = "";                  ///< "" for a plain number
  std::vector<std::string_view> choices = {};  ///< for a word
};

/// Passes of a layer (Lum & Ma, Figure 10) that a style works on.
enum class StylePasses {
  kColour,  ///< pass I alone: colour and extinction
  kLines,   ///< pass II alone: what lines there are; colour and extinction are left alone
  kBoth,    ///< colour and extinction, and the amount of lines
};

/// One style: a key under "style" of a layer, a snippet node/shaders/styles/<name>.glsl with
/// function apply_<name>, and a branch in the reference renderer.
struct StyleSpec {
  std::string_view name;
  std::string_view help;
  bool needsGradient = false;
  /// Depends on where the sample lies. The parameters then have "along" (view or axis) and "axis".
  bool needsPosition = false;
  StylePasses passes = StylePasses::kColour;
  bool needsLaplacian = false;
  /// Where a clip plane cuts, the surface it shades is the cut.
  bool seesCuts = false;
  int ghostLayers = 0;     ///< voxels beyond the brick's own that its look-ups touch
  bool hasSnippet = true;  ///< false: settings read by shared code (gradient)
  std::vector<ParameterSpec> parameters;
};

/// All styles in the order in which their effects apply.
std::span<const StyleSpec> styleTable();
/// nullptr if there is none.
const StyleSpec* findStyle(std::string_view name);

/// One style as a layer uses it: every parameter has a value, in the order of the table.
struct StyleSettings {
  std::string name;
  std::vector<ParameterValue> values;

  /// By parameter name; BURIN_CHECKs that it exists and has that kind.
  double number(std::string_view parameter) const;
  const Colour& colour(std::string_view parameter) const;
  const std::string& word(std::string_view parameter) const;
  const Curve& curve(std::string_view parameter) const;
  const ColourCurve& colourCurve(std::string_view parameter) const;
  const glm::dvec3& direction(std::string_view parameter) const;
  friend bool operator==(const StyleSettings&, const StyleSettings&) = default;
};

/// A style with its defaults.
StyleSettings defaultSettings(const StyleSpec& spec);

/// The table as text for people: a line per style, its parameters with range, unit and default.
std::string styleHelp();

}  // namespace burin
