#include "scene_codec.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "burin/common/scene.hpp"

namespace burin::scene_io {

namespace {

constexpr std::size_t kAnyCount = std::numeric_limits<std::size_t>::max();

/// "in [0, 1]", "greater than 0"; "" without limits.
std::string rangeText(const Range& range) {
  const bool below = std::isfinite(range.minimum);
  const bool above = std::isfinite(range.maximum);
  if (below && above) {
    return fmt::format(" in {}{}, {}{}", range.minimumExcluded ? '(' : '[', range.minimum,
                       range.maximum, range.maximumExcluded ? ')' : ']');
  }
  if (below) {
    return fmt::format(" {} {}", range.minimumExcluded ? "greater than" : "of at least",
                       range.minimum);
  }
  return "";
}

double readNumber(const At& at, const Range& range, bool whole = false) {
  const Node& node = at.node;
  const double x = node.number;
  const bool inside = (range.minimumExcluded ? x > range.minimum : x >= range.minimum) &&
                      (range.maximumExcluded ? x < range.maximum : x <= range.maximum);
  if (node.kind != Node::Kind::kNumber || !inside || (whole && std::trunc(x) != x)) {
    at.fail("expected a {}number{}, found {}", whole ? "whole " : "", rangeText(range),
            json::shown(node));
  }
  return x;
}

Document numberSchema(const Range& range, bool whole = false) {
  Document schema{{"type", whole ? "integer" : "number"}};
  if (std::isfinite(range.minimum)) {
    schema[range.minimumExcluded ? "exclusiveMinimum" : "minimum"] =
        json::numberDocument(range.minimum);
  }
  if (std::isfinite(range.maximum)) {
    schema[range.maximumExcluded ? "exclusiveMaximum" : "maximum"] =
        json::numberDocument(range.maximum);
  }
  return schema;
}

const std::string& readText(const At& at) {
  if (at.node.kind != Node::Kind::kText) {
    at.fail("expected text, found {}", json::shown(at.node));
  }
  return at.node.text;
}

Colour readColour(const At& at) {
  const std::string& written = readText(at);
  try {
    return parseColour(written);
  } catch (const Error& error) {
    at.fail("{}", error.what());
  }
}

Document colourSchema() {
  return {{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"}};
}

/// A list of `Count` numbers as Vector, whose components are of type Number.
template <typename Vector, int Count, typename Number>
Codec<Vector> numbers(Range component) {
  constexpr bool kWhole = std::is_integral_v<Number>;
  Codec<Vector> codec;
  codec.schema = listSchema(Count, Count, numberSchema(component, kWhole));
  codec.read = [component](const At& at) {
    checkList(at, Count, Count);
    Vector vector;
    for (int i = 0; i < Count; ++i) {
      vector[i] =
          static_cast<Number>(readNumber(at.item(static_cast<std::size_t>(i)), component, kWhole));
    }
    return vector;
  };
  codec.write = [](const Vector& vector) {
    Document document = Document::array();
    for (int i = 0; i < Count; ++i) document.push_back(json::numberDocument(vector[i]));
    return document;
  };
  return codec;
}

template <typename V>
Codec<ParameterValue> asParameter(Codec<V> codec) {
  return {[codec](const At& at) { return ParameterValue{codec.read(at)}; },
          [codec](const ParameterValue& value) { return codec.write(std::get<V>(value)); },
          codec.schema};
}

}  // namespace

Codec<bool> boolean() {
  return {[](const At& at) {
            if (at.node.kind != Node::Kind::kBoolean)
              at.fail("expected true or false, found {}", json::shown(at.node));
            return at.node.boolean;
          },
          [](const bool& value) { return Document(value); },
          {{"type", "boolean"}}};
}

Codec<double> number(Range range) {
  return {[range](const At& at) { return readNumber(at, range); },
          [](const double& value) { return json::numberDocument(value); }, numberSchema(range)};
}

Codec<std::string> text() {
  return {[](const At& at) { return readText(at); },
          [](const std::string& value) { return Document(value); }, Document{{"type", "string"}}};
}

Codec<std::string> word(std::vector<std::string_view> choices) {
  Codec<std::string> codec = text();
  codec.schema = {{"enum", choices}};
  codec.read = [choices](const At& at) {
    const std::string& written = readText(at);
    if (std::find(choices.begin(), choices.end(), written) == choices.end()) {
      at.fail("'{}' is unknown; {}", written, nameSuggestion(written, choices));
    }
    return written;
  };
  return codec;
}

Codec<Colour> colour() {
  return {readColour, [](const Colour& value) { return Document(value.hex()); }, colourSchema()};
}

Codec<std::optional<Colour>> colourOrTransparent() {
  using Maybe = std::optional<Colour>;
  return {[](const At& at) { return readText(at) == "transparent" ? Maybe{} : readColour(at); },
          [](const Maybe& value) { return Document(value ? value->hex() : "transparent"); },
          Document{{"anyOf", {colourSchema(), Document{{"const", "transparent"}}}}}};
}

Codec<glm::dvec2> risingPair(Range component) {
  Codec<glm::dvec2> codec = numbers<glm::dvec2, 2, double>(component);
  codec.read = [any = codec.read](const At& at) {
    const glm::dvec2 pair = any(at);
    if (!(pair.x < pair.y)) at.fail("expected rising values");
    return pair;
  };
  return codec;
}

Codec<glm::dvec3> vector3(Range component) {
  return numbers<glm::dvec3, 3, double>(component);
}

Codec<glm::dvec3> direction() {
  Codec<glm::dvec3> codec = vector3(kAnyNumber);
  codec.read = [any = codec.read](const At& at) {
    const glm::dvec3 vector = any(at);
    if (vector == glm::dvec3{0}) at.fail("a zero vector has no direction");
    return vector;
  };
  return codec;
}

Codec<glm::dvec4> clipPlaneVector() {
  Codec<glm::dvec4> codec = numbers<glm::dvec4, 4, double>(kAnyNumber);
  codec.read = [any = codec.read](const At& at) {
    const glm::dvec4 plane = any(at);
    if (glm::dvec3{plane} == glm::dvec3{0}) at.fail("a zero normal has no direction");
    return plane;
  };
  return codec;
}

Codec<int> wholeNumber(Range range) {
  return {[range](const At& at) { return static_cast<int>(readNumber(at, range, true)); },
          [](const int& value) { return Document(value); }, numberSchema(range, true)};
}

Codec<glm::ivec3> wholeNumbers3(Range component) {
  return numbers<glm::ivec3, 3, int>(component);
}

Codec<ImageSize> imageSize() {
  const auto pair = numbers<glm::ivec2, 2, int>({.minimum = 1, .maximum = kLargestImageSide});
  return {[pair](const At& at) {
            const glm::ivec2 size = pair.read(at);
            return ImageSize{size.x, size.y};
          },
          [pair](const ImageSize& size) {
            return pair.write({size.width, size.height});
          },
          pair.schema};
}

namespace {

std::pair<double, double> parts(const glm::dvec2& point) {
  return {point.x, point.y};
}
std::pair<double, Colour> parts(const ColourPoint& point) {
  return {point.x, point.colour};
}

/// [x, y] pairs with strictly growing x, as a list of points made of both.
template <typename AnyCurve, typename Y>
Codec<AnyCurve> curveOf(Codec<Y> y) {
  using Point = typename decltype(AnyCurve::points)::value_type;
  Document pairSchema{{"type", "array"},
                      {"prefixItems", {numberSchema(kAnyNumber), y.schema}},
                      {"minItems", 2},
                      {"maxItems", 2}};
  Codec<AnyCurve> codec;
  codec.schema = listSchema(1, kMostCurvePoints, std::move(pairSchema));
  codec.read = [read = y.read](const At& at) {
    checkList(at, 1, kMostCurvePoints);
    AnyCurve result;
    for (std::size_t i = 0; i < at.node.items.size(); ++i) {
      const At pair = at.item(i);
      checkList(pair, 2, 2);
      const Point point{readNumber(pair.item(0), kAnyNumber), read(pair.item(1))};
      if (!result.points.empty() && point.x <= result.points.back().x) {
        pair.fail("{} does not grow over {} of the point before", point.x, result.points.back().x);
      }
      result.points.push_back(point);
    }
    return result;
  };
  codec.write = [write = y.write](const AnyCurve& value) {
    Document document = Document::array();
    for (const Point& point : value.points) {
      const auto [x, second] = parts(point);
      document.push_back({json::numberDocument(x), write(second)});
    }
    return document;
  };
  return codec;
}

}  // namespace

Codec<Curve> curve(Range y) {
  return curveOf<Curve>(number(y));
}

Codec<ColourCurve> colourCurve() {
  return curveOf<ColourCurve>(colour());
}

Codec<ParameterValue> parameter(const ParameterSpec& spec) {
  const Range range{.minimum = spec.minimum, .maximum = spec.maximum};
  if (std::holds_alternative<double>(spec.defaultValue)) return asParameter(number(range));
  if (std::holds_alternative<Colour>(spec.defaultValue)) return asParameter(colour());
  if (std::holds_alternative<std::string>(spec.defaultValue))
    return asParameter(word(spec.choices));
  if (std::holds_alternative<ColourCurve>(spec.defaultValue)) return asParameter(colourCurve());
  if (std::holds_alternative<glm::dvec3>(spec.defaultValue)) return asParameter(direction());
  return asParameter(curve(range));
}

void checkKeys(const At& at, const std::vector<std::string_view>& known) {
  if (at.node.kind != Node::Kind::kObject) {
    at.fail("expected an object, found {}", json::shown(at.node));
  }
  for (const json::Member& member : at.node.members) {
    if (std::find(known.begin(), known.end(), member.name) != known.end()) continue;
    At::failAt(member.where, json::childPath(at.path, member.name),
               fmt::format("unknown key; {}", nameSuggestion(member.name, known)));
  }
}

void forbid(const At& at, std::string_view key, std::string_view why) {
  if (const Node* found = at.node.find(key)) {
    At::failAt(found->where, json::childPath(at.path, key), why);
  }
}

void checkList(const At& at, std::size_t minimum, std::size_t maximum) {
  const std::size_t count = at.node.items.size();
  if (at.node.kind == Node::Kind::kList && count >= minimum && count <= maximum) return;
  const std::string wanted = minimum == maximum     ? fmt::format("{}", minimum)
                             : maximum == kAnyCount ? fmt::format("at least {}", minimum)
                                                    : fmt::format("{} to {}", minimum, maximum);
  const std::string found =
      at.node.kind == Node::Kind::kList ? fmt::format("{}", count) : json::shown(at.node);
  at.fail("expected a list of {} items, found {}", wanted, found);
}

Document objectSchema() {
  return {{"type", "object"}, {"properties", Document::object()}, {"additionalProperties", false}};
}

Document listSchema(std::size_t minimum, std::size_t maximum, Document itemSchema) {
  Document schema{{"type", "array"}, {"items", std::move(itemSchema)}};
  if (minimum > 0) schema["minItems"] = minimum;
  if (maximum != kAnyCount) schema["maxItems"] = maximum;
  return schema;
}

void addKeySchema(Document& object, const std::string& name, const std::string& help, bool required,
                  Document key, const std::optional<Document>& defaultValue) {
  Document described{{"description", help}};
  described.update(key);
  if (defaultValue) described["default"] = *defaultValue;
  object["properties"][name] = std::move(described);
  if (required) object["required"].push_back(name);
}

}  // namespace burin::scene_io
