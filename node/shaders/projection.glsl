// A brick's part of a projection: one number per ray, of the values at the samples of all its segments.
// Included by the generated program, which defines CLIP_PLANES, and MEAN or not.
//
// out  target 0: MEAN: (sum of value * length, sum of length), lengths in planes, to be added
//                else: the largest value, -infinity if there is none, of which the larger one counts
//
// Values are looked up alike in all bricks (exact.glsl), so the largest one is the same for any split.

#ifdef MEAN
layout(location = 0) out vec2 result;
#else
layout(location = 0) out float result;
#endif

#ifdef MEAN
// Adds to `sum`, whose rounding so far is `lost` (Kahan).
void addTo(inout float sum, inout float lost, float term) {
  precise float corrected = term - lost;
  precise float next = sum + corrected;
  precise float rounding = (next - sum) - corrected;
  sum = next;
  lost = rounding;
}
#endif

void main() {
  const float nothing = uintBitsToFloat(0xff800000u);  // -infinity
#ifdef MEAN
  result = vec2(0.0);
  vec2 sum = vec2(0.0), lost = vec2(0.0);
#else
  result = nothing;
  float largest = nothing;
#endif
  Ray ray = pixelRay();
  int j, last;
  if (!ownedSegments(ray, j, last)) return;

  SkipState skip = beginSkipping(ray, j);
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    vec2 look = exactLookUp(samplePosition(ray, j));
    bool counts = visit && look.y > 0.0;
#ifdef MEAN
    float planes = counts ? segmentEnd(ray, j) - segmentBegin(ray, j) : 0.0;
    addTo(sum.x, lost.x, planes * look.x);
    addTo(sum.y, lost.y, planes);
#else
    largest = counts ? max(largest, look.x) : largest;
#endif
#ifdef COUNT_SAMPLES
    visited += uint(visit);
    shaded += uint(counts);
    inOccupied +=
        uint(visit && isOccupied(skip, 0.5 * (segmentBegin(ray, j) + segmentEnd(ray, j))));
    leaps += uint(j != before);
#endif
    j += int(visit);
  }
#ifdef MEAN
  result = sum;
#else
  result = largest;
#endif
  addToCounters();
}
