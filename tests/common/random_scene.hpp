#pragma once

#include <random>

#include "burin/common/scene.hpp"

namespace burin::test {

/// A scene that a file could say, with every field somewhere in its range.
Scene randomScene(std::mt19937& random);

}  // namespace burin::test
