// Which samples are this brick's, and the counters of samples. A sample has exactly one owner, because
// every brick decides by the same numbers on the same position (lattice.glsl).

uniform vec3 brickLo, brickHi;   // owns samples lo <= p < hi; +-1e30 at the volume's own faces

bool owned(vec3 position) {
  return all(greaterThanEqual(position, brickLo)) && all(lessThan(position, brickHi));
}

#ifdef COUNT_SAMPLES
layout(std430, binding = 0) buffer Counters { uint visited, shaded, inOccupied, leaps; } counters;
#endif
