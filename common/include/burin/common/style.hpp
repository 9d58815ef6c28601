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

/// A number, a colour, one word of a list, or a curve.
using ParameterValue = std::variant<double, Colour, std::string, Curve>;

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

/// One style: a key under "style" of a layer, a snippet node/shaders/styles/<name>.glsl with
/// function apply_<name>, and a branch in the reference renderer.
struct StyleSpec {
  std::string_view name;
  std::string_view help;
  bool needsGradient = false;
  /// Pass II (Lum & Ma): adds to the line and leaves colour and extinction alone.
  bool drawsLines = false;
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
  friend bool operator==(const StyleSettings&, const StyleSettings&) = default;
};

/// A style with its defaults.
StyleSettings defaultSettings(const StyleSpec& spec);

/// The table as text for people: a line per style, its parameters with range, unit and default.
std::string styleHelp();

}  // namespace burin
