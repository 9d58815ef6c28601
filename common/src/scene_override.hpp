#pragma once

#include <functional>
#include <string>

#include "json_node.hpp"

namespace burin::scene_io {

/// json::applyOverride() as people mean it in a scene: what cannot stand beside the new value goes,
/// unless it was said by another override (angles where a view or an eye is given, a step where an
/// error is asked for and the other way round, styles where a layer becomes a projection); and a
/// style by name leaves the layer the gradients it has, unless the style has its own. `expand`
/// replaces the names of styles and files in `root` by what they stand for.
void applySceneOverride(json::Node& root, const std::string& override,
                        const std::function<void()>& expand);

}  // namespace burin::scene_io
