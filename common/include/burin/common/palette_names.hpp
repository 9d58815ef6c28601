#pragma once

#include "burin/common/scene.hpp"

namespace burin {

// As in scene files.

constexpr const char* name(Normals normals) {
  return normals == Normals::kQuantised ? "quantised" : "exact";
}

constexpr const char* name(Palettes palettes) {
  return palettes == Palettes::kBefore ? "before" : "after";
}

}  // namespace burin
