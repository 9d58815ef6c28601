#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json_node.hpp"

namespace burin::json {

/// Applies "layers.0.style.tone.strength=0.5" to a document: replaces or adds the value at that
/// path (list items also as "layers[0]"). The value is JSON, or a bare word taken as text; null
/// removes the key. Missing objects on the way are made, and a list grows by one at its end.
/// Throws Error{kUsage} naming the override.
void applyOverride(Node& root, std::string_view override);

/// The keys and numbers of list items on the way to what an override sets.
std::vector<std::string> pathOf(std::string_view override);

}  // namespace burin::json
