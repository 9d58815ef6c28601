#pragma once

#include "burin/common/scene.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// Every key of a scene file with its range, default and help; styles come from styleTable().
const Codec<Scene>& sceneCodec();

}  // namespace burin::scene_io
