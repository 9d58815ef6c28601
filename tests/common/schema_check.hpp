#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace burin::test {

/// "" if `value` satisfies the schema, else the path and keyword it breaks. Knows the keywords that
/// our schema uses, and complains about any other.
std::string schemaViolation(const nlohmann::json& value, const nlohmann::json& schema,
                            const std::string& path = "");

}  // namespace burin::test
