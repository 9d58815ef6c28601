#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/colour.hpp"
#include "burin/common/nearest_name.hpp"
#include "burin/common/style.hpp"
#include "json_format.hpp"
#include "json_node.hpp"

/// How each kind of value in a scene file is read (with its checks), written and described: one
/// object per kind, so that parser, writer and schema cannot disagree.
namespace burin::scene_io {

using json::At;
using json::Document;
using json::Node;

template <typename V>
struct Codec {
  std::function<V(const At&)> read;  ///< throws Error{kUsage} with place, path and range
  std::function<Document(const V&)> write;
  Document schema;  ///< type and limits, as JSON Schema
};

/// Limits of a number; an open end is excluded.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimumExcluded = false;
  bool maximumExcluded = false;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.minimum = 0, .minimumExcluded = true};

Codec<double> number(Range range);
Codec<bool> boolean();
Codec<std::string> text();
Codec<std::string> word(std::vector<std::string_view> choices);
Codec<Colour> colour();
/// A colour, or the word "transparent" for none.
Codec<std::optional<Colour>> colourOrTransparent();
/// Two numbers, the second above the first.
Codec<glm::dvec2> risingPair(Range component);
Codec<glm::dvec3> vector3(Range component);
/// A direction: any vector but zero.
Codec<glm::dvec3> direction();
/// [a, b, c, d] whose a, b, c are such a direction.
Codec<glm::dvec4> clipPlaneVector();
Codec<int> wholeNumber(Range range);
Codec<glm::ivec3> wholeNumbers3(Range component);
Codec<ImageSize> imageSize();
/// [x, y] pairs with strictly growing x.
Codec<Curve> curve(Range y);
/// [x, colour] pairs with strictly growing x.
Codec<ColourCurve> colourCurve();
/// A style parameter, by the kind of its default.
Codec<ParameterValue> parameter(const ParameterSpec& spec);

/// One key of an object T: its name and help stand here and nowhere else.
template <typename T>
struct Field {
  std::string name;
  std::string help;
  bool required = false;
  std::function<void(const At&, T&)> read;
  std::function<std::optional<Document>(const T&)> write;  ///< nothing: the key is left out
  Document schema;
};

/// A key whose value is kept by `set(target, value)` and found by `get(source)` as an optional
/// (nothing: not written). Both are types of their own instead of std::function, of which each kind
/// of key would need two more: half of what the compiler made of scene files.
template <typename T, typename V, typename Get, typename Set>
Field<T> field(std::string_view name, std::string_view help, Codec<V> codec, Get get, Set set) {
  Field<T> made{std::string{name}, std::string{help}, false, {}, {}, std::move(codec.schema)};
  made.read = [read = std::move(codec.read), set](const At& at, T& target) {
    set(target, read(at));
  };
  made.write = [write = std::move(codec.write), get](const T& source) -> std::optional<Document> {
    const std::optional<V> value = get(source);
    return value ? std::optional{write(*value)} : std::nullopt;
  };
  return made;
}

/// A key that is a member, always written.
template <typename T, typename V>
Field<T> field(std::string_view name, std::string_view help, V T::*member, Codec<V> codec) {
  return field<T, V>(
      name, help, std::move(codec), [member](const T& t) { return std::optional<V>{t.*member}; },
      [member](T& t, V value) { t.*member = std::move(value); });
}

/// A key that is an optional member, written when set.
template <typename T, typename V>
Field<T> field(std::string_view name, std::string_view help, std::optional<V> T::*member,
               Codec<V> codec) {
  return field<T, V>(
      name, help, std::move(codec), [member](const T& t) { return t.*member; },
      [member](T& t, V value) { t.*member = std::move(value); });
}

template <typename T>
Field<T> required(Field<T> made) {
  made.required = true;
  return made;
}

template <typename T>
using Fields = std::vector<Field<T>>;

/// Throws unless the value is an object with known keys only.
void checkKeys(const At& at, const std::vector<std::string_view>& known);
/// Throws if the object has that key.
void forbid(const At& at, std::string_view key, std::string_view why);
/// Throws unless the value is a list with `minimum` to `maximum` items.
void checkList(const At& at, std::size_t minimum, std::size_t maximum);
Document objectSchema();
Document listSchema(std::size_t minimum, std::size_t maximum, Document itemSchema);
void addKeySchema(Document& object, const std::string& name, const std::string& help, bool required,
                  Document key, const std::optional<Document>& defaultValue);

/// An object with these keys. Keys that are absent leave what `initial` has, which is therefore the
/// default that the schema shows. `check` looks at the whole (keys that exclude each other).
template <typename T>
Codec<T> object(Fields<T> fields, std::function<void(const At&, const T&)> check = {},
                T initial = T{}) {
  Codec<T> codec;
  codec.schema = objectSchema();
  for (const Field<T>& f : fields) {
    addKeySchema(codec.schema, f.name, f.help, f.required, f.schema,
                 f.required ? std::nullopt : f.write(initial));
  }
  // Shared: reader and writer of an outer object hold this one's, and would copy it at each level.
  const auto keys = std::make_shared<const Fields<T>>(std::move(fields));
  codec.read = [keys, check, initial](const At& at) {
    std::vector<std::string_view> known;
    for (const Field<T>& f : *keys) known.push_back(f.name);
    checkKeys(at, known);
    T result = initial;
    for (const Field<T>& f : *keys) {
      if (const Node* value = at.node.find(f.name)) {
        f.read({*value, json::childPath(at.path, f.name)}, result);
      } else if (f.required) {
        at.fail("'{}' is missing", f.name);
      }
    }
    if (check) check(at, result);
    return result;
  };
  codec.write = [keys](const T& source) {
    Document document = Document::object();
    for (const Field<T>& f : *keys) {
      if (std::optional<Document> value = f.write(source)) document[f.name] = std::move(*value);
    }
    return document;
  };
  return codec;
}

/// A list of `minimum` to `maximum` such values.
template <typename V>
Codec<std::vector<V>> list(Codec<V> item, std::size_t minimum, std::size_t maximum) {
  Codec<std::vector<V>> codec;
  codec.schema = listSchema(minimum, maximum, std::move(item.schema));
  codec.read = [read = std::move(item.read), minimum, maximum](const At& at) {
    checkList(at, minimum, maximum);
    std::vector<V> values;
    for (std::size_t i = 0; i < at.node.items.size(); ++i) values.push_back(read(at.item(i)));
    return values;
  };
  codec.write = [write = std::move(item.write)](const std::vector<V>& values) {
    Document document = Document::array();
    for (const V& value : values) document.push_back(write(value));
    return document;
  };
  return codec;
}

}  // namespace burin::scene_io
