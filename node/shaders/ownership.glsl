// Which samples are this brick's. A sample has exactly one owner, because
// every brick decides by the same numbers on the same position (lattice.glsl).

uniform vec3 brickLo, brickHi;   // owns samples lo <= p < hi; +-1e30 at the volume's own faces

bool owned(vec3 position) {
  return all(greaterThanEqual(position, brickLo)) && all(lessThan(position, brickHi));
}

// The brick's segments on a ray, from `first` to `last` (none if that is before it); false if the ray
// passes it by. The brick's own interval only bounds the search, a plane wider at each end than rounding
// needs; ownership decides. Owned samples are consecutive, because every coordinate is monotonic in j.
bool ownedSegments(Ray ray, out int first, out int last) {
  vec2 mine = boxInterval(ray.origin, ray.along, max(brickLo, boxLo), min(brickHi, boxHi));
  if (!(ray.begin < ray.end) || mine.x > mine.y + 1.0) return false;
  first = int(floor(max(mine.x - 1.5, ray.begin)));
  last = int(ceil(min(mine.y + 1.5, ray.end))) - 1;
  while (first <= last && !owned(samplePosition(ray, first))) ++first;
  while (last > first && !owned(samplePosition(ray, last))) --last;
  return true;
}
