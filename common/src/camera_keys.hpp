#pragma once

#include "burin/common/scene.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// The keys of "camera": orbit angles, or a named view, or eye with target and up.
Codec<CameraChoice> cameraCodec();

}  // namespace burin::scene_io
