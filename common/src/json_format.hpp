#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace burin::json {

/// A document to write; keeps the order of keys.
using Document = nlohmann::ordered_json;

/// A number as people write it: 300, not 300.0. Reads back as the same double.
Document numberDocument(double value);

/// Text for people: what fits on a line stands on one line (a transfer-function point, a vector),
/// except that a list of objects and the top object take a line per entry. Numbers are as short as
/// they can be and read back exactly; text that is not UTF-8 gets replacement characters.
std::string format(const Document& document);

}  // namespace burin::json
