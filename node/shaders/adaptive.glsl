// The march of raycast.glsl for a largest error instead of a step. Lattice planes lie a voxel apart; their
// segments are cut where the ray passes from cell to cell, as the field has a kink there that look-ups
// to both sides of it may miss, and the pieces are halved until that changes their colour and opacity by
// no more than `tolerance`. Included by raycast.glsl, for pre-integrated classification.
//
// STEEP transfer functions may show something only between the values that were looked up. Within a cell
// the value is a cubic along the ray, so that three values and the cubic's own part say how far it goes
// beyond them: nothing hides in between.
//
// A piece's parts are the nodes of a binary tree, walked from front to back. Whether one is halved depends
// on its own values, neither on what lies before it nor on the brick.

uniform float tolerance;  // of premultiplied colour and opacity, for one part

const uint kUnits = 512u;     // a piece's smallest parts; their halves are looked at
const float kMargin = 1e-3;   // planes: the shortest piece

// A part's premultiplied colour and opacity. `world`: its length. A part of which one end lies in
// voxels that are not valid is nothing: halving finds where they begin.
vec4 partColour(vec3 coordinate, Side from, Side to, vec3 toEye, float world) {
  vec3 colour;
  float extinction;
  if (from.valid * to.valid == 0.0 || !classify(from, to)) return vec4(0.0);
  shade(coordinate, from, to, toEye, colour, extinction);
  float opacity = opacityOf(extinction * world);
  return vec4(colour * opacity, opacity);
}

#ifdef STEEP
// How much opacity may be amiss because the value goes further between the ends and the middle than
// they show: a parabola by an eighth of its second difference, of which twice as much is asked for to
// be safe, a cubic by about `twist`, its difference from the parabola at a quarter. No more than half of the
// part lies beyond them.
float doubt(Side front, Side middle, Side back, float twist, float world) {
  Side lowest = front;
  Side highest = front;
  if (middle.value < lowest.value) lowest = middle;
  if (middle.value > highest.value) highest = middle;
  if (back.value < lowest.value) lowest = back;
  if (back.value > highest.value) highest = back;
  float reach = 0.25 * abs(front.value - 2.0 * middle.value + back.value) + 2.0 * twist;
  Side below = lowest;
  Side above = highest;
  below.value -= reach;
  above.value += reach;
  classifySide(below);
  classifySide(above);
  return 0.5 * world * (changeBeyond(lowest, below) + changeBeyond(highest, above));
}
#endif

// Where the ray, in voxels from a corner of a voxel, next crosses a plane of voxels behind `from`. One
// that is reached within kMargin counts as crossed.
float nextFace(vec3 origin, vec3 along, float from) {
  vec3 cell = floor(origin + (from + kMargin) * along);
  vec3 exits = (cell + vec3(greaterThan(along, vec3(0.0))) - origin) / along;
  exits = mix(exits, vec3(kFar), lessThanEqual(exits, vec3(from + kMargin)));
  return min(exits.x, min(exits.y, exits.z));
}

void main() {
  result = vec4(0.0);
  float sufficient = sufficientOpacity();
  if (sufficient <= 0.0) return;
  Ray ray = pixelRay();
  int j, last;
  if (!ownedSegments(ray, j, last)) return;

  uint visited = 0u, shaded = 0u, inOccupied = 0u, leaps = 0u;
  SkipState skip = beginSkipping(ray, j);
  prepareVolume();
  prepareLights();
  prepareLayers();
  vec3 coordinateOrigin = textureCoordinate(ray.origin);
  vec3 coordinateAlong = ray.along * texelSize;
  vec3 toEye = directionToEye();
  vec4 sum = vec4(0.0);
  Side front;
  front.value = front.valid = 0.0;
  bool begun = false;  // whether `front` is where the next part begins
  float pieceFrom = segmentBegin(ray, j);
  uint done = 0u;      // of the piece, in units
  uint size = kUnits;  // of the part that is looked at
#ifdef STEEP
  float twist = 0.0;  // of the piece: how far its cubic is from a parabola at a quarter
#endif
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    begun = begun && j == before;
    pieceFrom = max(pieceFrom, segmentBegin(ray, j));
    float segmentTo = segmentEnd(ray, j);
    float pieceTo = min(nextFace(skip.origin * kCell, skip.along * kCell, pieceFrom), segmentTo);
    float unit = (pieceTo - pieceFrom) * (1.0 / float(kUnits));
    precise float begin = pieceFrom + float(done) * unit;
    precise float end = pieceFrom + float(done + size) * unit;
    precise float centre = 0.5 * (begin + end);
    // A run of segments begins with a round for its first end.
    Side back = sideAt(coordinateOrigin + (begun ? end : begin) * coordinateAlong);
    vec3 coordinate = coordinateOrigin + centre * coordinateAlong;
    Side middle = sideAt(coordinate);
    vec3 quarter = 0.25 * (end - begin) * coordinateAlong;
#ifdef STEEP
    vec2 early = volumeLookUp(coordinate - quarter);
    if (size == kUnits)
      twist = early.y * abs(early.x - 0.375 * front.value - 0.75 * middle.value + 0.125 * back.value);
#endif
    bool sampled = visit && begun;
    bool accepted = false;
    if (sampled) {
      float world = (end - begin) * ray.planeWorld;
      vec4 whole = partColour(coordinate, front, back, toEye, world);
      vec4 first = partColour(coordinate - quarter, front, middle, toEye, 0.5 * world);
      vec4 second = partColour(coordinate + quarter, middle, back, toEye, 0.5 * world);
      vec4 halves = first + (1.0 - first.a) * second;
      vec4 change = abs(halves - whole);
      float largest = max(max(change.r, change.g), max(change.b, change.a));
#ifdef STEEP
      float part = float(size) * (1.0 / float(kUnits));
      largest = max(largest, doubt(front, middle, back, twist * part * part * part, world));
#endif
      accepted = size == 1u || largest <= tolerance;
      if (accepted) {
        sum += (1.0 - sum.a) * halves;
        shaded += uint(first.a > 0.0) + uint(second.a > 0.0);
      }
    }
    if (sampled && !accepted) {
      size >>= 1;
    } else {
      front = back;
      if (sampled) done += size;
      size = kUnits;
      if (done > 0u && done < kUnits) size = done & (~done + 1u);  // its lowest bit: the next node
    }
    begun = visit;
#ifdef COUNT_SAMPLES
#ifdef STEEP
    uint looked = sampled ? 3u : 0u;
#else
    uint looked = sampled ? 2u : 0u;
#endif
    visited += looked;
    inOccupied += skip.occupied ? looked : 0u;
    leaps += uint(j != before);
#endif
    if (done == kUnits) {
      j += int(pieceTo >= segmentTo);
      pieceFrom = pieceTo;
      done = 0u;
    }
    last = sum.a > sufficient ? j - 1 : last;
  }
  result = sum;
#ifdef COUNT_SAMPLES
  atomicAdd(counters.visited, visited);
  atomicAdd(counters.shaded, shaded);
  atomicAdd(counters.inOccupied, inOccupied);
  atomicAdd(counters.leaps, leaps);
#endif
}
