#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace burin::node {

/// A name with a number in it, as printf has it: "slice%03d.raw".
struct NumberPattern {
  std::string before;
  std::size_t width = 0;  ///< digits at least, filled up with zeros
  std::string after;

  std::string name(long number) const;
};

/// Nothing if there is no %d, %3d or %03d in the text, or more than one.
std::optional<NumberPattern> parseNumberPattern(std::string_view text);

}  // namespace burin::node
