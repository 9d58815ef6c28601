#pragma once

#include <filesystem>

#include "json_format.hpp"
#include "json_node.hpp"

namespace burin::scene_io {

/// Puts points in place of each layer's "transfer_function" that names a colour map's "file"
/// (relative to `folder`); "map" and "range" beside it say which one and over which values. Throws
/// Error{kUsage}.
void expandColourMaps(json::Node& scene, const std::filesystem::path& folder);

/// What a "transfer_function" with a file may hold, as JSON Schema.
const json::Document& colourMapChoiceSchema();

}  // namespace burin::scene_io
