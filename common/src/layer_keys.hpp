#pragma once

#include "burin/common/scene.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// The keys of one of "layers": transfer function and styles.
Codec<Layer> layerCodec();

}  // namespace burin::scene_io
