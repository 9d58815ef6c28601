// Feature halos: what neighbours of a place, outlines of something the layer shows, cast on it. The
// neighbours are six around it in the picture's plane. After shading.glsl and a transfer function's scale.
//
// Space of offsets: the camera's axes (right, up, to the eye), in smallest spacings.

uniform mat3 haloAxes;   // such an offset in index space
uniform mat3 haloFrame;  // a world direction along the camera's axes

struct HaloNeighbours {
  float radius, aside;  // HaloNeighbourhood
  float toMagnitude;    // of a difference of stored values at +-aside: m
  float noiseFloor;     // m below which there is no direction
  float outward;        // 1: features are denser than their surroundings, -1 the other way
  float unitLength;     // world length of the layer's opacities
  float directionPower, edgePower;
};

// How opaque the layer is where values are those of a feature's inside.
float featureOpacity(sampler1DArray table, vec4 scale, vec2 visibleBins, float value, float unitLength) {
  float x = (value - scale.x) * scale.y;
  float extinction = texture(table, vec2((x + 0.5) * scale.w, 0.0)).a;
  return x > visibleBins.x && x < visibleBins.y ? opacityOf(extinction * unitLength) : 0.0;
}

// What is cast on a place as if it had no gradient itself: 0 … 1 per unitLength.
float haloAt(vec3 coordinate, vec3 toEye, HaloNeighbours n, sampler1DArray table, vec4 scale,
             vec2 visibleBins) {
  vec3 eye = haloFrame * toEye;
  vec3 acrossStep = haloAxes[0] * texelSize;
  vec3 upStep = haloAxes[1] * texelSize;
  vec3 eyeStep = n.aside * haloAxes[2] * texelSize;
  float sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    float angle = radians(60.0) * float(i);
    vec2 direction = vec2(cos(angle), sin(angle));
    vec3 outStep = direction.x * acrossStep + direction.y * upStep;
    vec3 sideStep = n.aside * (direction.x * upStep - direction.y * acrossStep);
    vec3 at = coordinate - n.radius * outStep;
    vec2 inside = volumeLookUp(at - n.aside * outStep);
    vec2 outside = volumeLookUp(at + n.aside * outStep);
    vec2 left = volumeLookUp(at + sideStep);
    vec2 right = volumeLookUp(at - sideStep);
    vec2 near = volumeLookUp(at + eyeStep);
    vec2 far = volumeLookUp(at - eyeStep);
    float valid = inside.y * outside.y * left.y * right.y * near.y * far.y;
    // Along: from the neighbour here, aside, to the eye.
    vec3 fall = n.outward * n.toMagnitude *
                vec3(inside.x - outside.x, right.x - left.x, far.x - near.x);
    float size = length(fall);
    vec3 normal = size > 0.0 ? fall / size : vec3(0.0);
    vec3 eyeHere = vec3(dot(direction, eye.xy), dot(vec2(-direction.y, direction.x), eye.xy), eye.z);
    float m = min(size, 1.0);
    float edge = max(1.0 - abs(dot(normal, eyeHere)), 0.0) *
                 smoothstep(n.noiseFloor, 2.0 * n.noiseFloor, m);
    float opacity = featureOpacity(table, scale, visibleBins, inside.x, n.unitLength);
    sum += valid * opacity * m * pow(max(normal.x, 0.0), n.directionPower) * pow(edge, n.edgePower);
  }
  return min(sum * (2.0 / 3.0), 1.0) / n.unitLength;
}
