// The global planar sample lattice (design: "planar lattice, clipped mid-point segments, per-sample
// ownership"). Space: centred index space, one unit per voxel, origin at the centre of the volume's
// box, evaluated in double on the CPU. Plane j is j planes behind the plane nearest that centre.
//
// in   gl_FragCoord: pixel centres; framebuffer row 0 is the picture's top row
// All positions are `precise`: every brick must compute the same sample positions, bit for bit.

uniform vec2 imageCentre;          // pixels
uniform vec3 base, baseX, baseY;   // position on plane 0 of the image centre; change per pixel
uniform vec3 along, alongX, alongY;  // change per plane of the image centre; change of it per pixel
uniform float nearPlane;           // smallest allowed j: the eye's own plane, or -1e30
uniform float stepWorld;           // world distance of planes
uniform float pixelSlope;          // perspective: pixel size at depth 1; orthographic: 0
uniform vec3 boxLo, boxHi;         // the volume's box
#ifdef CLIP_PLANES
uniform vec4 clipPlane[CLIP_PLANES];  // keeps dot(xyz, p) + w >= 0
#endif

const float kFar = 1e30;

// 1, which the compiler does not know. The driver fetches a uniform anew at each use, eight times over,
// in some twenty instructions, and moves nothing out of loops; a plain copy made before the loop over
// samples is undone by the compiler, a product is not.
uniform float one;

struct Ray {
  vec3 origin;      // on plane 0
  vec3 along;       // per plane
  float planeWorld; // world length between planes
  float begin, end; // the ray's part inside box, clip planes and before the eye, in planes
};

// Where origin + j * along lies between lo and hi, as (begin, end); begin > end where it never does.
vec2 boxInterval(vec3 origin, vec3 direction, vec3 lo, vec3 hi) {
  precise vec2 interval = vec2(-kFar, kFar);
  for (int axis = 0; axis < 3; ++axis) {
    precise float o = origin[axis];
    precise float d = direction[axis];
    if (abs(d) < 1e-25) {
      if (o < lo[axis] || o > hi[axis]) interval = vec2(kFar, -kFar);
      continue;
    }
    precise float toLo = (lo[axis] - o) / d;
    precise float toHi = (hi[axis] - o) / d;
    interval = vec2(max(interval.x, min(toLo, toHi)), min(interval.y, max(toLo, toHi)));
  }
  return interval;
}

Ray pixelRay() {
  Ray ray;
  precise vec2 f = gl_FragCoord.xy - imageCentre;
  precise vec3 origin = base + f.x * baseX + f.y * baseY;
  precise vec3 direction = along + f.x * alongX + f.y * alongY;
  precise vec2 interval = boxInterval(origin, direction, boxLo, boxHi);
  interval.x = max(interval.x, nearPlane);
#ifdef CLIP_PLANES
  for (int i = 0; i < CLIP_PLANES; ++i) {
    precise float height = dot(clipPlane[i].xyz, origin) + clipPlane[i].w;
    precise float rise = dot(clipPlane[i].xyz, direction);
    if (abs(rise) < 1e-25) {
      if (height < 0.0) interval = vec2(kFar, -kFar);
    } else if (rise > 0.0) {
      interval.x = max(interval.x, -height / rise);
    } else {
      interval.y = min(interval.y, -height / rise);
    }
  }
#endif
  vec2 slope = pixelSlope * f;
  ray.origin = origin;
  ray.along = direction;
  ray.planeWorld = stepWorld * sqrt(1.0 + dot(slope, slope));
  ray.begin = interval.x;
  ray.end = interval.y;
  return ray;
}

// Segment j is [j, j+1] clipped to the ray's interval; its middle is the sample.
float segmentBegin(Ray ray, int j) {
  precise float a = max(float(j), ray.begin);
  return a;
}
float segmentEnd(Ray ray, int j) {
  precise float b = min(float(j + 1), ray.end);
  return b;
}
vec3 samplePosition(Ray ray, int j) {
  precise float middle = 0.5 * (segmentBegin(ray, j) + segmentEnd(ray, j));
  precise vec3 position = ray.origin + middle * ray.along;
  return position;
}
