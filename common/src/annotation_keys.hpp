#pragma once

#include "burin/common/annotations.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// The keys of "annotations".
Codec<Annotations> annotationsCodec();

}  // namespace burin::scene_io
