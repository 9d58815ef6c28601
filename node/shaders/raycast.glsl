// Marches one brick's part of each ray, front to back. Included by the generated program, which
// defines LAYERS, LIGHTS, CLIP_PLANES, the classification of each layer and shadeSample().
//
// out  target 0: premultiplied linear RGBA of this brick alone

layout(location = 0) out vec4 result;

uniform vec3 brickLo, brickHi;   // owns samples lo <= p < hi; +-1e30 at the volume's own faces
uniform float termination;       // a ray ends when its transmittance is below; 0: never

#ifdef COUNT_SAMPLES
layout(std430, binding = 0) buffer Counters { uint visited, shaded, inOccupied, leaps; } counters;
#endif

bool owned(vec3 position) {
  return all(greaterThanEqual(position, brickLo)) && all(lessThan(position, brickHi));
}

// 1 - exp(-x), accurate for small x (the driver's exp is not).
float opacityOf(float x) {
  return x < 0.01 ? x * (1.0 - 0.5 * x * (1.0 - x * (1.0 / 3.0))) : 1.0 - exp(-x);
}

void main() {
  result = vec4(0.0);
  Ray ray = pixelRay();
  // The brick's own interval only bounds the search, a plane wider at each end than rounding needs;
  // ownership decides. Owned samples are consecutive, because every coordinate is monotonic in j.
  vec2 mine = boxInterval(ray.origin, ray.along, max(brickLo, boxLo), min(brickHi, boxHi));
  if (!(ray.begin < ray.end) || mine.x > mine.y + 1.0) return;
  int j = int(floor(max(mine.x - 1.5, ray.begin)));
  int last = int(ceil(min(mine.y + 1.5, ray.end))) - 1;
  while (j <= last && !owned(samplePosition(ray, j))) ++j;
  while (last > j && !owned(samplePosition(ray, last))) --last;

  uint visited = 0u, shaded = 0u, inOccupied = 0u, leaps = 0u;
  SkipState skip = SkipState(j, false);
  vec3 toEye = directionToEye();
  vec4 sum = vec4(0.0);
  while (j <= last) {
    vec3 position = samplePosition(ray, j);
    if (j >= skip.knownUntil) {
      int next = nextVisit(ray, j, position, skip);
      if (next != j) {
        j = next;
        ++leaps;
        continue;
      }
    }
    ++visited;
    if (skip.occupied) ++inOccupied;
    vec3 colour;
    float extinction;
    if (shadeSample(position, toEye, colour, extinction)) {
      ++shaded;
      float length = (segmentEnd(ray, j) - segmentBegin(ray, j)) * ray.planeWorld;
      float weight = (1.0 - sum.a) * opacityOf(extinction * length);
      sum += vec4(colour * weight, weight);
      if (1.0 - sum.a < termination) break;
    }
    ++j;
  }
  result = sum;
#ifdef COUNT_SAMPLES
  atomicAdd(counters.visited, visited);
  atomicAdd(counters.shaded, shaded);
  atomicAdd(counters.inOccupied, inOccupied);
  atomicAdd(counters.leaps, leaps);
#endif
}
