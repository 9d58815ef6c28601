#include "burin/common/style.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin {

namespace {

const ParameterValue& value(const StyleSettings& settings, std::string_view parameter) {
  const StyleSpec* spec = findStyle(settings.name);
  BURIN_CHECK(spec != nullptr);
  BURIN_CHECK_EQ(settings.values.size(), spec->parameters.size());
  const auto found = std::find_if(spec->parameters.begin(), spec->parameters.end(),
                                  [&](const ParameterSpec& p) { return p.name == parameter; });
  BURIN_CHECK(found != spec->parameters.end());
  return settings.values[static_cast<std::size_t>(found - spec->parameters.begin())];
}

template <typename T>
const T& valueAs(const StyleSettings& settings, std::string_view parameter) {
  const T* typed = std::get_if<T>(&value(settings, parameter));
  BURIN_CHECK(typed != nullptr);
  return *typed;
}

std::string shown(const Curve& curve) {
  std::string text = "[";
  for (const glm::dvec2& point : curve.points) {
    text += fmt::format("{}[{}, {}]", text.size() > 1 ? ", " : "", point.x, point.y);
  }
  return text + "]";
}

std::string shown(const ColourCurve& curve) {
  std::string text = "[";
  for (const ColourPoint& point : curve.points) {
    text += fmt::format("{}[{}, {}]", text.size() > 1 ? ", " : "", point.x, point.colour.hex());
  }
  return text + "]";
}

/// The points before and after x, and how far x is on the way; the end point twice outside.
template <typename Point>
struct Between {
  const Point& before;
  const Point& after;
  double t;
};
template <typename Point>
Between<Point> between(const std::vector<Point>& points, double x) {
  BURIN_CHECK(!points.empty());
  const auto above = std::upper_bound(points.begin(), points.end(), x,
                                      [](double v, const Point& p) { return v < p.x; });
  if (above == points.begin()) return {points.front(), points.front(), 0};
  if (above == points.end()) return {points.back(), points.back(), 0};
  const Point& before = *(above - 1);
  return {before, *above, (x - before.x) / (above->x - before.x)};
}

/// What may stand after the parameter's name, and its default.
std::string valueHelp(const ParameterSpec& spec) {
  const std::string_view space = spec.unit.empty() ? "" : " ";
  if (const auto* number = std::get_if<double>(&spec.defaultValue)) {
    return fmt::format("{} … {}{}{}, default {}", spec.minimum, spec.maximum, space, spec.unit,
                       *number);
  }
  if (const auto* colour = std::get_if<Colour>(&spec.defaultValue)) {
    return fmt::format("colour, default {}", colour->hex());
  }
  if (const auto* word = std::get_if<std::string>(&spec.defaultValue)) {
    return fmt::format("{}, default {}", fmt::join(spec.choices, " | "), *word);
  }
  if (const auto* colours = std::get_if<ColourCurve>(&spec.defaultValue)) {
    return fmt::format("curve of colours, default {}", shown(*colours));
  }
  if (const auto* direction = std::get_if<glm::dvec3>(&spec.defaultValue)) {
    return fmt::format("direction, default [{}, {}, {}]", direction->x, direction->y, direction->z);
  }
  return fmt::format("curve with values {} … {}{}{}, default {}", spec.minimum, spec.maximum, space,
                     spec.unit, shown(std::get<Curve>(spec.defaultValue)));
}

}  // namespace

double Curve::at(double x) const {
  const auto [before, after, t] = between(points, x);
  return (1 - t) * before.y + t * after.y;
}

glm::dvec3 ColourCurve::at(double x) const {
  const auto [before, after, t] = between(points, x);
  return (1 - t) * before.colour.linear() + t * after.colour.linear();
}

const StyleSpec* findStyle(std::string_view name) {
  const auto table = styleTable();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const StyleSpec& s) { return s.name == name; });
  return found == table.end() ? nullptr : &*found;
}

double StyleSettings::number(std::string_view parameter) const {
  return valueAs<double>(*this, parameter);
}
const Colour& StyleSettings::colour(std::string_view parameter) const {
  return valueAs<Colour>(*this, parameter);
}
const std::string& StyleSettings::word(std::string_view parameter) const {
  return valueAs<std::string>(*this, parameter);
}
const Curve& StyleSettings::curve(std::string_view parameter) const {
  return valueAs<Curve>(*this, parameter);
}

const ColourCurve& StyleSettings::colourCurve(std::string_view parameter) const {
  return valueAs<ColourCurve>(*this, parameter);
}
const glm::dvec3& StyleSettings::direction(std::string_view parameter) const {
  return valueAs<glm::dvec3>(*this, parameter);
}

StyleSettings defaultSettings(const StyleSpec& spec) {
  StyleSettings settings{std::string{spec.name}, {}};
  for (const ParameterSpec& parameter : spec.parameters) {
    settings.values.push_back(parameter.defaultValue);
  }
  return settings;
}

std::string styleHelp() {
  std::string text;
  for (const StyleSpec& style : styleTable()) {
    text += fmt::format("{:<14}{}\n", style.name, style.help);
    for (const ParameterSpec& parameter : style.parameters) {
      text +=
          fmt::format("  {:<16}{} ({})\n", parameter.name, parameter.help, valueHelp(parameter));
    }
  }
  return text;
}

}  // namespace burin
