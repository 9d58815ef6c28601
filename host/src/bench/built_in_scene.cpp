#include "bench/built_in_scene.hpp"

#include <fmt/format.h>

#include <utility>

namespace burin::host::bench {

PreparedScene builtInScene(std::string_view name, std::string_view text,
                           std::unique_ptr<node::BrickSource> source) {
  PreparedScene prepared;
  prepared.scene = parseScene(text, fmt::format("built-in scene {}", name));
  prepared.source = std::move(source);
  const node::VolumeInfo& info = prepared.source->info();
  prepared.facts = {info.grid, info.anatomical};
  resolveScene(prepared.scene, prepared.facts);
  return prepared;
}

}  // namespace burin::host::bench
