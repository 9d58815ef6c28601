#pragma once

#include "burin/common/scene.hpp"

namespace burin {

/// "sum", "over", as in scene files.
constexpr const char* name(Combine combine) {
  return combine == Combine::kOver ? "over" : "sum";
}

}  // namespace burin
