#pragma once

#include <glm/glm.hpp>

#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// Local. The procedural head in a square frame of twice the volume's `side` voxels, evaluated
/// whenever it is loaded.
PreparedScene strongScene(int side);

/// Local. The head with `cells`³ cells for each of `ranks` ranks, in memory, in a square frame
/// whose pixels grow with its area, so that the samples per rank stay what they are.
PreparedScene weakScene(int cells, int ranks);
/// Its dims: as near to a cube of ranks as their number's factors allow.
glm::ivec3 weakDims(int cells, int ranks);

/// Local. The measurement of Lum & Ma, "Hardware-Accelerated Parallel Non-Photorealistic Volume
/// Rendering", NPAR 2002: `side`³ voxels (512 there) in a frame of `side`² pixels, with tone
/// shading and edges; the skull alone or the skin around it too. In memory.
PreparedScene lumMaScene(int side, int layers);

}  // namespace burin::host::bench
