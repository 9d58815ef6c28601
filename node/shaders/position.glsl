// Where samples lie along a direction, for styles that depend on it.

// A linear function of the position, dot(xyz, p) + w in centred index space, as one of the coordinate in
// the brick's texture.
vec4 overCoordinate(vec4 place) {
  return vec4(place.xyz / textureScale, place.w - dot(place.xyz, textureOffset));
}

// Its value, 0 … 1.
float positionAt(vec4 place, vec3 coordinate) {
  return clamp(dot(place.xyz, coordinate) + place.w, 0.0, 1.0);
}
