// Empty-space skipping in one brick. The map holds, per macrocell of kCell^3 cells, minus a mask of those
// of its octants that may be visible (bit x + 2 y + 4 z), or, if none is, the chessboard distance in
// macrocells to the nearest one in which some may be. Macrocells are aligned to the global grid. Leaving
// samples out never changes a picture: positions stay on the lattice and only samples in empty octants
// are passed over.

uniform isampler3D cellMap;      // filters to the nearest: texelFetch would cost twice as much
uniform vec3 cellOffset;         // added to a position: voxels from the map's corner
uniform float skipEmpty;         // 0: visit everything (for comparison), else 1

const float kCell = 4.0;   // kMacrocellSize in macrocells.hpp
// Planes; far above the rounding of an exit, and at most 1e-3 voxels, by how much the ranges of
// macrocells may be overstepped (kWidening in octant_plane.cpp).
uniform float exitMargin;

// The ray in units of macrocells, and what leaving them takes.
struct SkipState {
  vec3 origin, along;  // along is never 0
  vec3 inverse;        // of along
  vec3 halves;         // planes that crossing half a macrocell takes along each axis
  vec4 octantBits;     // an octant's number: its change past the middles, and of the first
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
  state.halves = 0.5 * abs(state.inverse);
  vec3 bits = mix(vec3(-1.0, -2.0, -4.0), vec3(1.0, 2.0, 4.0), greaterThan(state.along, vec3(0.0)));
  state.octantBits = vec4(bits, dot(max(-bits, 0.0), vec3(1.0)));
  vec3 cells = vec3(textureSize(cellMap, 0));
  state.lastCell = cells - 1.0;
  state.perMap = 1.0 / cells;
  state.margin = one * exitMargin;
  state.leaps = one * skipEmpty;
  state.knownUntil = j;
  state.occupied = false;
  state.emptyUntil = segmentBegin(ray, j);
  return state;
}

// The octant at `where` planes: whether it may be visible, and how far the ray stays in it, or in
// macrocells that are empty as a whole.
float octantExit(inout SkipState state, float where) {
  vec3 cell = clamp(floor(state.origin + where * state.along), vec3(0.0), state.lastCell);
  vec3 middle = cell + 0.5;
  int entry = texture(cellMap, middle * state.perMap).r;
  vec3 middles = (middle - state.origin) * state.inverse;
  vec3 past = vec3(greaterThanEqual(vec3(where), middles));
  int octant = int(dot(past, state.octantBits.xyz) + state.octantBits.w);
  state.occupied = entry < 0 && (-entry >> octant & 1) != 0;
  vec3 reach = entry < 0 ? past : vec3(2.0 * float(entry) - 1.0);  // half macrocells
  vec3 exits = middles + reach * state.halves;
  return min(exits.x, min(exits.y, exits.z));
}

#ifdef COUNT_SAMPLES
// Whether the octant at `where` planes may be visible.
bool isOccupied(SkipState state, float where) {
  octantExit(state, where);
  return state.occupied;
}
#endif

// What is known of the segments from j on. Afterwards either segment j needs a visit, as do all
// before knownUntil, or j was moved on to the next segment that may need one.
#if defined(PREINTEGRATED) || defined(SURFACES)
// A segment needs a visit if it crosses any octant that may be visible.
void lookAhead(Ray ray, inout int j, inout SkipState state) {
  float from = max(segmentBegin(ray, j), state.emptyUntil);
  float exit = min(octantExit(state, from), ray.end + 1.0);
  // Without progress in this number format the segment counts as occupied.
  state.occupied = state.occupied || !(exit + state.margin > from);
  state.emptyUntil = state.occupied ? from : exit + state.margin;
  int begunBefore = max(j + 1, int(ceil(exit)));
  int emptyBefore = int(floor(exit + state.margin));  // the segment in which the exit lies
  state.knownUntil = state.occupied ? begunBefore : emptyBefore;
  j = state.occupied || state.leaps <= 0.0 ? j : emptyBefore;
}
#else
// A segment needs a visit if its sample is in an octant that may be visible.
void lookAhead(Ray ray, inout int j, inout SkipState state) {
  float where = 0.5 * (segmentBegin(ray, j) + segmentEnd(ray, j));
  float exit = min(octantExit(state, where), ray.end + 1.0);
  // Samples lie at j + 1/2, or before it in the last segment: all below the exit share this box.
  state.knownUntil = max(j + 1, int(ceil(exit - state.margin - 0.5)));
  j = state.occupied || state.leaps <= 0.0 ? j : state.knownUntil;
}
#endif
