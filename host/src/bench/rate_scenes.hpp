#pragma once

#include "burin/common/scene.hpp"

namespace burin::host::bench {

/// How much a scene's layers let through.
enum class Look {
  kOpaque,       ///< as the scene has it
  kTranslucent,  ///< opacities times 0.03
};

enum class Shading {
  kPlain,      ///< transfer functions alone
  kToneEdges,  ///< tone and edges with their defaults in every layer
};

/// "opaque", "translucent"; "plain", "tone-edges".
const char* name(Look look);
const char* name(Shading shading);

/// `scene` (resolved), drawn that way.
Scene drawnAs(Scene scene, Look look, Shading shading);

/// What keeps every lane of the same program busy from the first round to the last: a parallel view
/// along the volume's third axis of a frame that its face fills, rays as dense as in `scene`, in
/// which everything shows and nothing ends a ray or is clipped. Opacities are raised to 1e-4, the
/// transfer functions' points and the numbers of layers, lights and clip planes stay: the program
/// and the size of its tables, too. `scene`: resolved; the volume's axes are at right angles.
Scene withAllLanesBusy(Scene scene, const VolumeFacts& facts);

}  // namespace burin::host::bench
