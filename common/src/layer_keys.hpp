#pragma once

#include "burin/common/scene.hpp"
#include "scene_codec.hpp"

namespace burin::scene_io {

/// The keys of one of "layers": transfer function and styles.
Codec<Layer> layerCodec();

/// A key for each style of the table, as under "style"; named styles are already expanded.
Codec<std::vector<StyleSettings>> stylesCodec();

/// "transfer_function" with its points.
Codec<TransferFunction> transferFunctionCodec();

}  // namespace burin::scene_io
