// Gradients whose direction is the nearest of 240 (direction_palette.hpp): folded by mirrors into one
// chamber of the icosahedron's symmetry, where three of them lie, and back.

uniform vec3 mirrors[3];            // unit normals, towards the chamber
uniform vec3 paletteDirections[3];  // in the chamber
vec3 mirror[3], paletteDirection[3];

// Before the loop over samples (see `one`).
void prepareDirections() {
  for (int i = 0; i < 3; ++i) {
    mirror[i] = one * mirrors[i];
    paletteDirection[i] = one * paletteDirections[i];
  }
}

// Mirroring in turn, five times all three, brings any direction into the chamber: the longest element
// of the group is the fifth power of their product.
const int kMirrorings = 15;

vec3 quantisedGradient(vec3 gradient) {
  float size = length(gradient);
  vec3 folded = gradient / max(size, 1e-30);
  float mirrored[kMirrorings];  // 2 where it was, else 0
  for (int i = 0; i < kMirrorings; ++i) {
    float height = dot(mirror[i % 3], folded);
    mirrored[i] = height < 0.0 ? 2.0 : 0.0;
    folded -= mirrored[i] * height * mirror[i % 3];
  }
  vec3 nearest = paletteDirection[0];
  for (int i = 1; i < 3; ++i)
    if (dot(paletteDirection[i], folded) > dot(nearest, folded)) nearest = paletteDirection[i];
  for (int i = kMirrorings - 1; i >= 0; --i)
    nearest -= mirrored[i] * dot(mirror[i % 3], nearest) * mirror[i % 3];
  return size * nearest;
}
