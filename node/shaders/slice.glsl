// One layer's one pass on one slice: the samples between two lattice planes that one brick owns, in the
// slices technique. Included by the generated program, which defines LIGHTS, CLIP_PLANES,
// PREINTEGRATED, the classification of the layer, shade(), and what the pass writes:
//
// LAYER_IMAGE  pass I:  target 0: (colour, optical depth), replacing what is there
//              pass II: target 0: (line colour * amount, the line's optical depth), index 1: amount.
//                       Blended as rgb + (1 - amount) * rgb below and as the larger depth, which is
//                       drawLines() of the fused program.
// otherwise    target 0: premultiplied linear RGBA, to be blended over the frame

layout(location = 0, index = 0) out vec4 result;
#if defined(LAYER_IMAGE) && defined(LINES_ONLY)
layout(location = 0, index = 1) out vec4 cover;
#endif

uniform int slice;  // the segment's number, the same on all rays

void main() {
  Ray ray = pixelRay();
  bool crossed =
      ray.begin < ray.end && float(slice) < ray.end && float(slice + 1) > ray.begin;
  bool mine = crossed && owned(samplePosition(ray, slice));
  SkipState skip = beginSkipping(ray, slice);
  int j = slice;
  while (mine && j == slice && skip.knownUntil <= slice) lookAhead(ray, j, skip);
  bool sampled = mine && j == slice;

  prepareVolume();
  prepareLights();
  prepareLayers();
  vec3 coordinateOrigin = textureCoordinate(ray.origin);
  vec3 coordinateAlong = ray.along * texelSize;
  float begin = segmentBegin(ray, slice);
  float end = segmentEnd(ray, slice);
  vec3 coordinate = coordinateOrigin + 0.5 * (begin + end) * coordinateAlong;
#ifdef LABELS
  lookUpLabels(coordinate);
#endif
#ifdef PREINTEGRATED
  Side front = sideAt(coordinateOrigin + begin * coordinateAlong);
  Side back = sideAt(coordinateOrigin + end * coordinateAlong);
#ifdef INVALID_VOXELS
  vec2 middle = volumeLookUp(coordinate);
  front = mended(front, middle.x);
  back = mended(back, middle.x);
  bool visible = sampled && classify(front, back) && middle.y > 0.0;
#else
  bool visible = sampled && classify(front, back);
#endif
#elif defined(PALETTES_BEFORE)
  bool visible = sampled && classify(cellAt(coordinate));
#else
  vec2 middle = volumeLookUp(coordinate);
  bool visible = sampled && classify(middle.x) && middle.y > 0.0;
#endif

  vec3 colour = vec3(0.0);
  float extinction = 0.0;
  if (visible) {
#ifdef PREINTEGRATED
    shade(coordinate, front, back, directionToEye(), colour, extinction);
#else
    shade(coordinate, directionToEye(), colour, extinction);
#endif
#ifdef HALOS
    visible = extinction > 0.0;  // classify() cannot tell
#endif
  }
  float depth = extinction * (end - begin) * ray.planeWorld;
#ifdef LAYER_IMAGE
#ifdef LINES_ONLY
  float amount = visible ? lineAmount : 0.0;
  result = amount > 0.0 ? vec4(colour * amount, depth) : vec4(0.0);
  cover = vec4(amount);
#else
  result = visible ? vec4(colour, depth) : vec4(0.0);
#endif
#else
  float opacity = visible ? opacityOf(depth) : 0.0;
  result = vec4(colour * opacity, opacity);
#endif
#ifdef COUNT_SAMPLES
  visited = uint(sampled);
  shaded = uint(visible);
  inOccupied = uint(sampled && isOccupied(skip, 0.5 * (begin + end)));
  leaps = uint(mine && !sampled);
#endif
  if (mine) addToCounters();
}
