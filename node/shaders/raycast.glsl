// Marches one brick's part of each ray, front to back. Included by the generated program, which
// defines LAYERS, LIGHTS, CLIP_PLANES, PREINTEGRATED, SEVERAL_BRICKS, the classification of each layer
// and shade().
//
// out  target 0: premultiplied linear RGBA of this brick alone

layout(location = 0) out vec4 result;

uniform float termination;       // a ray ends when its transmittance is below; 0: never
#ifdef SEVERAL_BRICKS
uniform sampler2D frame;         // the target: what the bricks in front have drawn
#endif

// Opacity of this brick's part at which the ray ends; 0 or less if the bricks in front are enough.
float sufficientOpacity() {
#ifdef SEVERAL_BRICKS
  float transmittance = 1.0 - texelFetch(frame, ivec2(gl_FragCoord.xy), 0).a;
  return 1.0 - termination / max(transmittance, 1e-30);
#else
  return 1.0 - termination;
#endif
}

#include "march.glsl"
#ifdef ADAPTIVE
#include "adaptive.glsl"
#elif defined(SURFACES)
#include "surface_march.glsl"
#else
void main() {
  result = vec4(0.0);
  Ray ray;
  int j, last;
  SkipState skip;
  if (!beginMarch(ray, j, last, skip)) return;
  vec4 sum = vec4(0.0);
#ifdef PREINTEGRATED
  Side front;
  front.value = front.valid = 0.0;
  bool begun = false;  // whether `front` is where segment j begins
#endif
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    float begin = segmentBegin(ray, j);
    float end = segmentEnd(ray, j);
    vec3 coordinate = coordinateOrigin + 0.5 * (begin + end) * coordinateAlong;
#ifdef LABELS
    lookUpLabels(coordinate);
#endif
#ifdef PREINTEGRATED
    begun = begun && j == before;
    Side back = sideAt(coordinateOrigin + (begun ? end : begin) * coordinateAlong);
#ifdef INVALID_VOXELS
    vec2 middle = volumeLookUp(coordinate);
    bool counts = middle.y > 0.0;
    Side from = mended(front, middle.x);
    Side to = mended(back, middle.x);
#else
    const bool counts = true;
    Side from = front;
    Side to = back;
#endif
    bool sampled = visit && begun;
    bool visible = sampled && classify(from, to) && counts;
#else
    vec2 middle = volumeLookUp(coordinate);
    bool sampled = visit;
    bool visible = sampled && classify(middle.x) && middle.y > 0.0;
#endif
    if (visible) {
      vec3 colour;
      float extinction;
#ifdef PREINTEGRATED
      shade(coordinate, from, to, toEye, colour, extinction);
#else
      shade(coordinate, toEye, colour, extinction);
#endif
#ifdef HALOS
      visible = extinction > 0.0;  // classify() cannot tell
#endif
      float weight = (1.0 - sum.a) * opacityOf(extinction * (end - begin) * ray.planeWorld);
      sum += vec4(colour * weight, weight);
    }
#ifdef PREINTEGRATED
    front = back;
    begun = visit;
#endif
#ifdef COUNT_SAMPLES
    visited += uint(sampled);
    shaded += uint(visible);
    inOccupied += uint(sampled && isOccupied(skip, 0.5 * (begin + end)));
    leaps += uint(j != before);
#endif
    j += int(sampled);
    last = sum.a > sufficient ? j - 1 : last;
  }
  result = sum;
  addToCounters();
}
#endif
