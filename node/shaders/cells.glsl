// The adaptive march for steep transfer functions, which may show something only between any two values
// looked up. Segments are cut where the ray passes from cell to cell, as the field has a kink there.
// Within a cell it is a cubic along the ray: its ends and two look-ups between them say all of it. It is
// cut at its extremes, so that a stretch's values lie between its ends' and nothing hides from
// pre-integration; dividing stretches further takes no look-ups. Only in volumes with voxels that are
// not valid, where the field is no cubic, every part's end and middle are looked up.
//
// As values rise or fall all the way along a stretch, it meets a surface if and only if its ends lie on
// different sides, and meets it once. Parts that meet one are halved down to the smallest, a 512th of a
// stretch, in which the value goes on a line as far as a float tells.

const float kMargin = 1e-3;   // planes: the shortest piece of a cell
const float kFlat = 1.0 / 128.0;  // of a piece: extremes closer to its ends or each other do not count

// Where the ray, in voxels from a corner of a voxel, next crosses a plane of voxels behind `from`. One
// that is reached within kMargin counts as crossed.
float nextFace(vec3 origin, vec3 along, float from) {
  vec3 cell = floor(origin + (from + kMargin) * along);
  vec3 exits = (cell + vec3(greaterThan(along, vec3(0.0))) - origin) / along;
  exits = mix(exits, vec3(kFar), lessThanEqual(exits, vec3(from + kMargin)));
  return min(exits.x, min(exits.y, exits.z));
}

// c0 + c1 t + c2 t^2 + c3 t^3 through values at t = 0, 1/3, 2/3 and 1.
vec4 cubicThrough(float v0, float v1, float v2, float v3) {
  float d1 = v1 - v0;
  float d2 = v2 - 2.0 * v1 + v0;
  float d3 = v3 - v0 + 3.0 * (v1 - v2);
  return vec4(v0, 3.0 * d1 - 1.5 * d2 + d3, 4.5 * (d2 - d3), 4.5 * d3);
}
float cubicAt(vec4 c, float t) { return c.x + t * (c.y + t * (c.z + t * c.w)); }

// Where a cubic's derivative vanishes; kFar where it does not. The form without cancellation.
vec2 extremesOf(vec4 c) {
  float square = c.z * c.z - 3.0 * c.y * c.w;
  float root = sqrt(max(square, 0.0));
  float q = -(c.z + (c.z < 0.0 ? -root : root));
  float a = square > 0.0 && c.w != 0.0 ? q / (3.0 * c.w) : kFar;
  float b = square > 0.0 && q != 0.0 ? c.y / q : kFar;
  return vec2(a, b);
}
// The first extreme behind t, or the cubic's end.
float nextExtreme(vec2 extremes, float t) {
  vec2 next = mix(vec2(1.0), extremes, greaterThan(extremes, vec2(t + kFlat)));
  float first = min(next.x, next.y);
  return first < 1.0 - kFlat ? first : 1.0;
}

void main() {
  result = vec4(0.0);
  Ray ray;
  int j, last;
  SkipState skip;
  if (!beginMarch(ray, j, last, skip)) return;
  vec4 sum = vec4(0.0);
  Side front;
  front.value = front.valid = 0.0;
  bool begun = false;     // whether `front` is where the next part begins
  float pieceFrom = segmentBegin(ray, j);  // of the ray in the cell
  vec4 cubic = vec4(0.0);  // the values on the piece
  float from = 0.0;       // of the piece: where the stretch begins
  uint done = 0u;         // of the stretch, in units
  uint size = kUnits;     // of the part that is looked at
#ifdef SURFACES
  prepareSurfaces();
  int firstOwned = j, lastOwned = last;
  precise vec3 entry = ray.origin + segmentBegin(ray, j) * ray.along;
  precise vec3 exit = ray.origin + segmentEnd(ray, last) * ray.along;
  vec2 entryLook = exactLookUp(entry);
  vec2 exitLook = exactLookUp(exit);
  int side = 0;           // of where the part begins
#endif
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    begun = begun && j == before;
    pieceFrom = max(pieceFrom, segmentBegin(ray, j));
    float segmentTo = segmentEnd(ray, j);
    float pieceTo = min(nextFace(skip.origin * kCell, skip.along * kCell, pieceFrom), segmentTo);
    float planes = pieceTo - pieceFrom;
    bool sampled = visit && begun;
    bool isNew = from == 0.0 && done == 0u && size == kUnits;
    // A run of segments begins with a round for its first end.
    vec3 pieceEnd = coordinateOrigin + (begun ? pieceTo : pieceFrom) * coordinateAlong;
    vec3 third = (planes * (1.0 / 3.0)) * coordinateAlong;
    float endValue = volumeLookUp(pieceEnd).x;
    vec4 looked = cubicThrough(front.value, volumeLookUp(pieceEnd - 2.0 * third).x,
                               volumeLookUp(pieceEnd - third).x, endValue);
    if (isNew) cubic = looked;
    float to = nextExtreme(extremesOf(cubic), from);
    float unit = (to - from) * (1.0 / float(kUnits));
    float begin = from + float(done) * unit;
    float end = from + float(done + size) * unit;
    float centre = 0.5 * (begin + end);
    vec3 coordinate = coordinateOrigin + (pieceFrom + centre * planes) * coordinateAlong;
    vec3 quarter = (0.25 * (end - begin) * planes) * coordinateAlong;
#ifdef INVALID_VOXELS
    Side middle = sideAt(coordinate);
    Side back = sideAt(begun ? coordinate + 2.0 * quarter : pieceEnd);
#else
    Side middle, back;
    middle.value = cubicAt(cubic, centre);
    back.value = begun ? cubicAt(cubic, end) : endValue;
    middle.valid = back.valid = 1.0;
    classifySide(middle);
    classifySide(back);
#endif
    float nearer = 0.5;  // part of it before the middle
#ifdef SURFACES
    // Where bricks meet the same in both (surface_march.glsl).
    float decisive = !begun && j == firstOwned ? entryLook.x : back.value;
    bool isExit = j == lastOwned && pieceTo >= segmentTo && to == 1.0 && done + size == kUnits;
    decisive = begun && isExit ? exitLook.x : decisive;
    int sideBehind = sideOf(decisive);
    int crossed = front.valid * back.valid > 0.0 ? side ^ sideBehind : 0;
    if (crossed != 0 && size == 1u) {
      middle.value = isoValues[firstMet(crossed, front.value)];
      middle.valid = 1.0;
      classifySide(middle);
      nearer = front.value == back.value
                   ? 0.5
                   : zeroOfLine(front.value - middle.value, back.value - middle.value);
      coordinate += (4.0 * nearer - 2.0) * quarter;
      quarter = vec3(0.0);
    }
#endif
    bool accepted = false;
    if (sampled) {
      float world = (end - begin) * planes * ray.planeWorld;
      vec4 whole = partColour(coordinate, front, back, toEye, world);
      vec4 first = partColour(coordinate - quarter, front, middle, toEye, nearer * world);
      vec4 second = partColour(coordinate + quarter, middle, back, toEye, (1.0 - nearer) * world);
#ifdef SURFACES
      vec4 met = surfaceColours(coordinate, middle, size == 1u ? crossed : 0, toEye);
      second = met + (1.0 - met.a) * second;
#endif
      vec4 halves = first + (1.0 - first.a) * second;
      // A stretch that shows something may agree with its halves by chance, but hardly twice.
      bool isJudged = size < kUnits || max(whole.a, halves.a) <= tolerance;
      accepted = size == 1u || (isJudged && largestDifference(halves, whole) <= tolerance &&
                                !meetsInvalid(front, middle, back));
#ifdef SURFACES
      accepted = accepted && (size == 1u || crossed == 0);
#endif
      if (accepted) {
        sum += (1.0 - sum.a) * halves;
        shaded += uint(first.a > 0.0) + uint(second.a > 0.0);
      }
    }
#ifdef COUNT_SAMPLES
    uint looks = isNew ? 3u : 0u;
#ifdef INVALID_VOXELS
    looks += 2u;
#endif
    looks = sampled ? looks : 0u;
    visited += looks;
    inOccupied += skip.occupied ? looks : 0u;
    leaps += uint(j != before);
#endif
    if (sampled && !accepted) {
      size >>= 1;
    } else {
      front = back;
#ifdef SURFACES
      side = sideBehind;
#endif
      if (sampled) done += size;
      size = nodeAfter(done);
    }
    begun = visit;
    if (done == kUnits) {
      done = 0u;
      from = to;
      if (to == 1.0) {
        from = 0.0;
        j += int(pieceTo >= segmentTo);
        pieceFrom = pieceTo;
      }
    }
    last = sum.a > sufficient ? j - 1 : last;
  }
  result = sum;
  addToCounters();
}
