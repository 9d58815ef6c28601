#pragma once

#include <memory>
#include <string_view>

#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// Local. A scene of the program's own, given as text, on the volume that `source` has.
PreparedScene builtInScene(std::string_view name, std::string_view text,
                           std::unique_ptr<node::BrickSource> source);

}  // namespace burin::host::bench
