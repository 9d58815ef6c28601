#pragma once

#include <span>
#include <string>
#include <string_view>

namespace burin {

/// Fewest insertions, deletions and replacements of bytes that turn `a` into `b`.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The end of a message about an unknown name: "did you mean 'strength'?" if a known name is near,
/// else "expected one of 'ambient', 'diffuse'". "" if nothing is known.
std::string nameSuggestion(std::string_view unknown, std::span<const std::string_view> known);

}  // namespace burin
