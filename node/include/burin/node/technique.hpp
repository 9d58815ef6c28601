#pragma once

#include "burin/common/scene.hpp"

namespace burin::node {

/// How a scene's layers and passes are drawn. Both take the same samples.
enum class Technique {
  kRaycast,  ///< one fused program that marches each ray
  kSlices,   ///< a draw for every sample plane, layer and pass, blended in the framebuffer
};

/// Of the framebuffer that slices are blended in.
enum class Precision {
  kFloat,  ///< 32 bits a channel
  kHalf,   ///< 16-bit floats
  kByte,   ///< 8 bits, as Lum & Ma's hardware had
};

/// "raycast", "slices"; "float", "half", "byte".
const char* name(Technique technique);
const char* name(Precision precision);

/// Throws Error{kUsage} if the scene cannot be drawn that way. The same on all ranks.
void checkTechnique(const Scene& scene, Technique technique, Precision precision);

}  // namespace burin::node
