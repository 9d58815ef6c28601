// The adaptive march for transfer functions that are not steep. A stretch is a segment of the lattice:
// its ends and its middle are looked up, then the middles of its parts. What the volume does between
// three look-ups is guessed from how far they are from a line (`doubt`).

// How much opacity may be amiss because the value goes further between the ends and the middle than
// they show: by no more than four times as much as the middle is off the line between the ends. No more
// than half of the part lies beyond them.
float doubt(Side front, Side middle, Side back, float world) {
  Side lowest = front;
  Side highest = front;
  if (middle.value < lowest.value) lowest = middle;
  if (middle.value > highest.value) highest = middle;
  if (back.value < lowest.value) lowest = back;
  if (back.value > highest.value) highest = back;
  float reach = 2.0 * abs(front.value - 2.0 * middle.value + back.value);
  Side below = lowest;
  Side above = highest;
  below.value -= reach;
  above.value += reach;
  classifySide(below);
  classifySide(above);
  return 0.5 * world * (changeBeyond(lowest, below) + changeBeyond(highest, above));
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
  bool begun = false;  // whether `front` is where the next part begins
  uint done = 0u;      // of the segment, in units
  uint size = kUnits;  // of the part that is looked at
  // What was looked up further back in the segment, and where, in units: the middle of the part that
  // was halved last, and its end.
  Side near = front, far = front;
  uint nearAt = 0u, farAt = 0u;
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    begun = begun && j == before;
    float from = segmentBegin(ray, j);
    float unit = (segmentEnd(ray, j) - from) * (1.0 / float(kUnits));
    precise float begin = from + float(done) * unit;
    precise float end = from + float(done + size) * unit;
    precise float centre = 0.5 * (begin + end);
    // A run of segments begins with a round for its first end.
    Side back = sideAt(coordinateOrigin + (begun ? end : begin) * coordinateAlong);
    bool isKnown = nearAt == done + size || farAt == done + size;
    if (nearAt == done + size) {
      back = near;
    } else if (isKnown) {
      back = far;
    }
    vec3 coordinate = coordinateOrigin + centre * coordinateAlong;
    Side middle = sideAt(coordinate);
    vec3 quarter = 0.25 * (end - begin) * coordinateAlong;
    bool sampled = visit && begun;
    bool accepted = false;
    if (sampled) {
      float world = (end - begin) * ray.planeWorld;
      vec4 whole = partColour(coordinate, front, back, toEye, world);
      vec4 first = partColour(coordinate - quarter, front, middle, toEye, 0.5 * world);
      vec4 second = partColour(coordinate + quarter, middle, back, toEye, 0.5 * world);
      vec4 halves = first + (1.0 - first.a) * second;
      float change = largestDifference(halves, whole) + doubt(front, middle, back, world);
      accepted = size == 1u || (change <= tolerance && !meetsInvalid(front, middle, back));
      if (accepted) {
        sum += (1.0 - sum.a) * halves;
        shaded += uint(first.a > 0.0) + uint(second.a > 0.0);
      }
    }
#ifdef COUNT_SAMPLES
    uint looked = sampled ? 2u - uint(isKnown) : 0u;
    visited += looked;
    inOccupied += skip.occupied ? looked : 0u;
    leaps += uint(j != before);
#endif
    if (sampled && !accepted) {
      far = back;
      farAt = done + size;
      size >>= 1;
      near = middle;
      nearAt = done + size;
    } else {
      front = back;
      if (sampled) done += size;
      size = nodeAfter(done);
    }
    begun = visit;
    if (done == kUnits) {
      ++j;
      done = nearAt = farAt = 0u;
    }
    last = sum.a > sufficient ? j - 1 : last;
  }
  result = sum;
  addToCounters();
}
