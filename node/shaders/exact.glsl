// Look-ups that are the same in every brick, bit for bit: the texture unit filters by coordinates of the
// brick's own texture, whose rounding differs from brick to brick; this weighs the eight voxels by the
// position itself.

uniform vec3 cellShift;    // added to a position: its whole part is a voxel's number, up to texelShift
uniform vec3 texelShift;   // whole numbers: the number of a voxel's texel

// `position`: centred index space. As volumeLookUp(): (value, 1 if valid).
vec2 exactLookUp(vec3 position) {
  precise vec3 shifted = position + cellShift;
  precise vec3 cell = floor(shifted);
  precise vec3 weight = shifted - cell;
  ivec3 last = textureSize(volume, 0) - 1;
  ivec3 lower = clamp(ivec3(cell + texelShift), ivec3(0), last);
  ivec3 upper = clamp(ivec3(cell + texelShift) + 1, ivec3(0), last);
  precise vec2 along[4];
  for (int i = 0; i < 4; ++i) {
    int y = (i & 1) == 0 ? lower.y : upper.y;
    int z = (i & 2) == 0 ? lower.z : upper.z;
    precise vec2 a = texelFetch(volume, ivec3(lower.x, y, z), 0).rg;
    precise vec2 b = texelFetch(volume, ivec3(upper.x, y, z), 0).rg;
    along[i] = a + weight.x * (b - a);
  }
  precise vec2 near = along[0] + weight.y * (along[1] - along[0]);
  precise vec2 far = along[2] + weight.y * (along[3] - along[2]);
  precise vec2 pair = near + weight.z * (far - near);
#ifdef INVALID_VOXELS
  return pair.y >= 0.5 ? vec2(pair.x / pair.y, 1.0) : vec2(0.0);
#else
  return vec2(pair.x, 1.0);
#endif
}
