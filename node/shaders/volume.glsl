// Look-ups in one brick's texture. Space of positions: centred index space. Values are normalised:
// 0 and 1 are the ends of the range the texture stores.
//
// INVALID_VOXELS: the texture holds (f * valid, valid); a sample is valid from valid = 1/2 on.

uniform sampler3D volume;
uniform vec3 textureOffset;  // added to a position: voxels from the texture's corner
uniform vec3 textureScale;   // 1 / texture size

vec3 textureCoordinate(vec3 position) {
  precise vec3 coordinate = (position + textureOffset) * textureScale;
  return coordinate;
}

#ifdef INVALID_VOXELS
// (value, 1 if valid)
vec2 volumeLookUp(vec3 coordinate) {
  vec2 pair = texture(volume, coordinate).rg;
  return pair.y >= 0.5 ? vec2(pair.x / pair.y, 1.0) : vec2(0.0);
}
#else
vec2 volumeLookUp(vec3 coordinate) { return vec2(texture(volume, coordinate).r, 1.0); }
#endif

#ifdef AT_VOXELS
// The voxel nearest to a place: the same on all bricks, bit for bit.
vec2 voxelLookUp(vec3 coordinate) {
  ivec3 size = textureSize(volume, 0);
  vec4 texel = texelFetch(volume, clamp(ivec3(floor(coordinate * vec3(size))), ivec3(0), size - 1), 0);
#ifdef INVALID_VOXELS
  return texel.rg;
#else
  return vec2(texel.r, 1.0);
#endif
}
#define GRADIENT_LOOK_UP voxelLookUp
#else
#define GRADIENT_LOOK_UP volumeLookUp
#endif

vec3 texelSize;  // textureScale, kept over the loop

void prepareVolume() { texelSize = one * textureScale; }

// Central differences of the trilinear field at +-1 voxel, per voxel, not halved. Zero where a tap
// is not valid. At a voxel with AT_VOXELS. Edges of the texture clamp, which at the volume's border is the definition.
vec3 volumeDifferences(vec3 coordinate) {
  vec3 difference;
  float valid = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    vec3 offset = vec3(0.0);
    offset[axis] = texelSize[axis];
    vec2 above = GRADIENT_LOOK_UP(coordinate + offset);
    vec2 below = GRADIENT_LOOK_UP(coordinate - offset);
    difference[axis] = above.x - below.x;
    valid *= above.y * below.y;
  }
  return difference * valid;
}
