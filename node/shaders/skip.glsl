// Empty-space skipping in one brick. The map holds, per macrocell of kCell^3 cells, the chessboard
// distance in macrocells to the nearest one that may be visible, or, for one that may be visible
// itself, minus the distance to the nearest one that cannot. Cells are aligned to the global grid. Leaving samples out never changes a picture: positions stay on
// the lattice and only samples in empty macrocells are passed over.

uniform isampler3D distanceMap;  // filters to the nearest: texelFetch would cost twice as much
uniform vec3 cellOffset;         // added to a position: voxels from the map's corner
uniform float skipEmpty;         // 0: visit everything (for comparison), else 1

const float kCell = 4.0;   // kMacrocellSize in macrocells.hpp
// Planes; far above the rounding of an exit, and at most 1e-3 voxels, by how much the ranges of
// macrocells may be overstepped (Macrocells::finish).
uniform float exitMargin;

// The ray in units of macrocells, and what leaving them takes.
struct SkipState {
  vec3 origin, along;  // along is never 0
  vec3 inverse;        // of along
  vec3 ahead;          // per axis 1 if the ray ascends, else 0
  vec3 lastCell;       // of the map
  vec3 perMap;         // 1 / cells of the map
  float margin;        // exitMargin
  float leaps;         // skipEmpty: above 0 if so
  int knownUntil;      // first segment of which nothing is known
  bool occupied;       // of the segments before knownUntil
  float emptyUntil;    // planes: the ray crosses nothing visible before
};

SkipState beginSkipping(Ray ray, int j) {
  SkipState state;
  state.origin = (ray.origin + cellOffset) * (1.0 / kCell);
  state.along = ray.along * (1.0 / kCell);
  for (int axis = 0; axis < 3; ++axis)
    if (abs(state.along[axis]) < 1e-25) state.along[axis] = 1e-25;
  state.inverse = 1.0 / state.along;
  state.ahead = vec3(greaterThan(state.along, vec3(0.0)));
  vec3 cells = vec3(textureSize(distanceMap, 0));
  state.lastCell = cells - 1.0;
  state.perMap = 1.0 / cells;
  state.margin = one * exitMargin;
  state.leaps = one * skipEmpty;
  state.knownUntil = j;
  state.occupied = false;
  state.emptyUntil = segmentBegin(ray, j);
  return state;
}

// The macrocell at `where` planes: whether it may be visible, and how far the ray stays in
// macrocells of which the same is true.
float macrocellExit(inout SkipState state, float where) {
  vec3 cell = floor(state.origin + where * state.along);
  cell = clamp(cell, vec3(0.0), state.lastCell);
  int distance = texture(distanceMap, (cell + 0.5) * state.perMap).r;
  state.occupied = distance < 0;
  float reach = float(abs(distance) - 1);
  vec3 corner = cell + state.ahead + (2.0 * state.ahead - 1.0) * reach;
  vec3 exits = (corner - state.origin) * state.inverse;
  return min(exits.x, min(exits.y, exits.z));
}

#ifdef COUNT_SAMPLES
// Whether the macrocell at `where` planes may be visible.
bool isOccupied(SkipState state, float where) {
  vec3 cell = clamp(floor(state.origin + where * state.along), vec3(0.0), state.lastCell);
  return texture(distanceMap, (cell + 0.5) * state.perMap).r < 0;
}
#endif

// What is known of the segments from j on. Afterwards either segment j needs a visit, as do all
// before knownUntil, or j was moved on to the next segment that may need one.
#if defined(PREINTEGRATED) || defined(SURFACES)
// A segment needs a visit if it crosses any macrocell that may be visible.
void lookAhead(Ray ray, inout int j, inout SkipState state) {
  float from = max(segmentBegin(ray, j), state.emptyUntil);
  float exit = min(macrocellExit(state, from), ray.end + 1.0);
  // Without progress in this number format the segment counts as occupied.
  state.occupied = state.occupied || !(exit + state.margin > from);
  state.emptyUntil = state.occupied ? from : exit + state.margin;
  int begunBefore = max(j + 1, int(ceil(exit)));
  int emptyBefore = int(floor(exit + state.margin));  // the segment in which the exit lies
  state.knownUntil = state.occupied ? begunBefore : emptyBefore;
  j = state.occupied || state.leaps <= 0.0 ? j : emptyBefore;
}
#else
// A segment needs a visit if its sample is in a macrocell that may be visible.
void lookAhead(Ray ray, inout int j, inout SkipState state) {
  float where = 0.5 * (segmentBegin(ray, j) + segmentEnd(ray, j));
  float exit = min(macrocellExit(state, where), ray.end + 1.0);
  // Samples lie at j + 1/2, or before it in the last segment: all below the exit share this box.
  state.knownUntil = max(j + 1, int(ceil(exit - state.margin - 0.5)));
  j = state.occupied || state.leaps <= 0.0 ? j : state.knownUntil;
}
#endif
