// Empty-space skipping in one brick. The map holds, per macrocell of kCell^3 cells, the chessboard
// distance in macrocells to the nearest one that may be visible (0: it may itself). Cells are
// aligned to the global cell grid. Leaving samples out never changes a picture: positions stay on
// the lattice and only samples in empty macrocells are passed over.

uniform usampler3D distanceMap;
uniform vec3 cellOffset;   // added to a position: voxels from the map's corner
uniform bool skipEmpty;    // false: visit everything (for comparison)

const float kCell = 4.0;   // kMacrocellSize in macrocells.hpp
// Planes; far above the rounding of an exit, far below a step's worth of samples.
const float kExitMargin = 1e-3;

struct SkipState {
  int knownUntil;  // first lattice index about whose macrocell nothing is known
  bool occupied;   // of the samples before knownUntil
};

// Looks up the macrocell of sample j at `position`. Sets state; returns the first index that needs
// a visit (j itself if the macrocell may be visible).
int nextVisit(Ray ray, int j, vec3 position, inout SkipState state) {
  vec3 inMap = position + cellOffset;
  ivec3 size = textureSize(distanceMap, 0);
  ivec3 cell = clamp(ivec3(floor(inMap / kCell)), ivec3(0), size - 1);
  int distance = int(texelFetch(distanceMap, cell, 0).r);
  int reach = max(distance - 1, 0);
  vec3 lo = vec3(cell - reach) * kCell - cellOffset;
  vec3 hi = vec3(cell + reach + 1) * kCell - cellOffset;
  float exit = boxInterval(ray.origin, ray.along, lo, hi).y;
  // Samples lie at j + 1/2, or before it in the last segment: all below the exit share this box.
  int next = max(j + 1, int(ceil(min(exit, ray.end + 1.0) - kExitMargin - 0.5)));
  state.knownUntil = next;
  state.occupied = distance == 0;
  return state.occupied || !skipEmpty ? j : next;
}
