#include "schema_check.hpp"

#include <regex.h>

#include <algorithm>
#include <stdexcept>

namespace burin::test {

namespace {

using nlohmann::json;

bool hasType(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

std::string objectViolation(const json& value, const json& schema, const std::string& path) {
  for (const auto& [key, child] : value.items()) {
    const auto known = schema.at("properties").find(key);
    if (known == schema.at("properties").end()) return path + "/" + key + ": additionalProperties";
    if (auto found = schemaViolation(child, *known, path + "/" + key); !found.empty()) return found;
  }
  for (const json& name : schema.value("required", json::array())) {
    if (!value.contains(name.get<std::string>())) return path + ": required";
  }
  return "";
}

std::string arrayViolation(const json& value, const json& schema, const std::string& path) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    const json& item =
        schema.contains("prefixItems") ? schema["prefixItems"].at(i) : schema.at("items");
    const std::string found = schemaViolation(value[i], item, path + "/" + std::to_string(i));
    if (!found.empty()) return found;
  }
  return "";
}

/// Whether a POSIX extended pattern is found in the text. (std::regex sets off gcc 12's false alarm
/// about uninitialised members.)
bool matches(const std::string& text, const std::string& pattern) {
  regex_t compiled;
  if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
    throw std::invalid_argument{"bad pattern " + pattern};
  }
  const bool found = regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
  regfree(&compiled);
  return found;
}

bool satisfies(const json& value, const std::string& keyword, const json& limit) {
  if (keyword == "type") return hasType(value, limit);
  if (keyword == "const") return value == limit;
  if (keyword == "enum") return std::find(limit.begin(), limit.end(), value) != limit.end();
  if (keyword == "pattern") return matches(value.get<std::string>(), limit.get<std::string>());
  if (keyword == "minimum") return value >= limit;
  if (keyword == "maximum") return value <= limit;
  if (keyword == "exclusiveMinimum") return value > limit;
  if (keyword == "exclusiveMaximum") return value < limit;
  if (keyword == "minItems") return value.size() >= limit.get<std::size_t>();
  if (keyword == "maxItems") return value.size() <= limit.get<std::size_t>();
  if (keyword == "anyOf") {
    return std::any_of(limit.begin(), limit.end(),
                       [&](const json& s) { return schemaViolation(value, s).empty(); });
  }
  const auto elsewhere = {"properties", "required",    "additionalProperties",
                          "items",      "prefixItems", "description",
                          "default",    "title",       "$schema"};
  return std::find(elsewhere.begin(), elsewhere.end(), keyword) != elsewhere.end();
}

}  // namespace

std::string schemaViolation(const json& value, const json& schema, const std::string& path) {
  if (schema.contains("type") && !hasType(value, schema["type"])) return path + ": type";
  for (const auto& [keyword, limit] : schema.items()) {
    if (!satisfies(value, keyword, limit)) return path + ": " + keyword;
  }
  if (schema.contains("anyOf")) return "";  // looked into what is inside
  if (value.is_object()) return objectViolation(value, schema, path);
  if (value.is_array()) return arrayViolation(value, schema, path);
  return "";
}

}  // namespace burin::test
