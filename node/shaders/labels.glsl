// Membership of a sample in masks, which are the voxels with some labels: the trilinear interpolation of
// the mask, 1 within and 0 outside, so that borders are smooth and the picture has no voxels' edges. All
// masks share one look-up of the eight voxels around the sample, weighted here in floats: the texture
// unit does not filter whole numbers, and 8-bit ones only with 8-bit weights.

uniform usampler3D labelMasks;  // bit n: the voxel is in mask n; filters to the nearest

vec3 labelVoxels;                  // along each axis of the texture
uvec4 masksBelow, masksAbove;      // of the voxels around the sample: in the slice below, above it
vec4 weightsBelow, weightsAbove;

// Before the loop over samples (see `one`).
void prepareLabels() { labelVoxels = vec3(textureSize(labelMasks, 0)); }

uvec4 masksOfSlice(vec2 lo, vec2 hi, float z) {
  return uvec4(texture(labelMasks, vec3(lo, z)).r, texture(labelMasks, vec3(hi.x, lo.y, z)).r,
               texture(labelMasks, vec3(lo.x, hi.y, z)).r, texture(labelMasks, vec3(hi, z)).r);
}

// For membership(). `coordinate`: of the volume's texture. Beyond the voxels' edge the last one counts.
void lookUpLabels(vec3 coordinate) {
  vec3 voxel = coordinate * labelVoxels - 0.5;
  vec3 cell = floor(voxel);
  vec3 above = voxel - cell;
  vec3 lo = (cell + 0.5) * texelSize;
  vec3 hi = lo + texelSize;
  masksBelow = masksOfSlice(lo.xy, hi.xy, lo.z);
  masksAbove = masksOfSlice(lo.xy, hi.xy, hi.z);
  vec2 x = vec2(1.0 - above.x, above.x);
  vec4 xy = vec4(x * (1.0 - above.y), x * above.y);
  weightsBelow = xy * (1.0 - above.z);
  weightsAbove = xy * above.z;
}

// Of the position looked up last, in [0, 1].
float membership(float mask) {
  uint bit = uint(mask);
  return dot(vec4((masksBelow >> bit) & 1u), weightsBelow) +
         dot(vec4((masksAbove >> bit) & 1u), weightsAbove);
}
