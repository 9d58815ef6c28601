// Cut surfaces: near a clip plane with a cap, light, tone and toon see the plane instead of the material's own
// gradient, which says nothing of a cut. By the distance from the plane, not by which segment it cuts, so
// that the cap is the same at every step.

uniform vec4 capPlanes[CAPS];       // dot(xyz, texture coordinate) + w: distance in units of kCapVoxels
uniform vec3 capDirections[CAPS];   // world, unit, to the side that is kept
vec4 capPlane[CAPS];
vec3 capDirection[CAPS];

void prepareCaps() {
  for (int i = 0; i < CAPS; ++i) {
    capPlane[i] = one * capPlanes[i];
    capDirection[i] = one * capDirections[i];
  }
}

// Sum of the near planes' directions, and how much of the surface is theirs.
vec4 capAt(vec3 coordinate) {
  vec4 cap = vec4(0.0);
  for (int i = 0; i < CAPS; ++i) {
    float weight = clamp(2.0 - (dot(capPlane[i].xyz, coordinate) + capPlane[i].w), 0.0, 1.0);
    cap = vec4(cap.xyz + weight * capDirection[i], max(cap.w, weight));
  }
  return cap;
}

// `g` where `cap` takes over from it; a cut surface's direction is certain.
Surface cutSurface(Surface g, vec4 cap, int orientation) {
  vec3 plane = normalAlong(cap.xyz, orientation, g.toEye);
  vec3 normal = (1.0 - cap.w) * g.confidence * g.normal + cap.w * plane;
  float size = length(normal);
  return Surface(size > 0.0 ? normal / size : vec3(0.0), g.magnitude, mix(g.confidence, 1.0, cap.w),
                 g.toEye);
}
