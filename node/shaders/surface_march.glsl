// The march of raycast.glsl for scenes with surfaces. Included by raycast.glsl.
//
// A segment whose ends lie on different sides of a surface holds a point of it. That is sought by false
// position, a round of the loop for each look-up, and cuts the segment: the medium before it, the surface,
// then what is left of the segment. So a round still looks up the volume once and shades once, the medium of
// a part or a surface.
//
// Whether a segment's ends are on different sides is decided on values that are the same in all bricks where
// segments of two bricks meet: of a surface at a split plane nothing is lost and nothing doubled.

const float kSought = 1e-5;  // of a segment: how near to the surface a point is
const int kMostLooks = 24;   // for it; each leaves a part of the rest

// What a round looks up, and then does.
const int kEnd = 0;      // the segment's end: the medium up to there, unless a surface comes first
const int kSeek = 1;     // a guess of where the surface is
const int kMeet = 2;     // where it is: the medium up to there
const int kSurface = 3;  // there: the surface

void main() {
  result = vec4(0.0);
  Ray ray;
  int j, last;
  SkipState skip;
  if (!beginMarch(ray, j, last, skip)) return;
  prepareSurfaces();
  vec4 sum = vec4(0.0);
  int firstOwned = j, lastOwned = last;
  precise vec3 entry = ray.origin + segmentBegin(ray, j) * ray.along;
  precise vec3 exit = ray.origin + segmentEnd(ray, last) * ray.along;
  vec2 entryLook = exactLookUp(entry);
  vec2 exitLook = exactLookUp(exit);

#ifdef PREINTEGRATED
  Side front;
  front.value = front.valid = 0.0;
#endif
  bool begun = false;             // whether what follows is known
  vec2 frontLook = vec2(0.0);     // where the part begins
  int side = 0;                   // of frontLook
  float from = 0.0;               // where that is: 0 the segment's begin, 1 its end
  int task = kEnd;
  float at = 1.0;                 // where the task is, in the same parts
  int met = 0;                    // the surface that is sought
  vec2 low = vec2(0.0), high = vec2(0.0);  // (where, value - iso-value), on either side of it
  int kept = 0;                   // of the last guess: 1 high was kept, -1 low
  int looks = 0;
  while (j <= last) {
    int before = j;
    if (j >= skip.knownUntil) lookAhead(ray, j, skip);
    bool visit = j < skip.knownUntil && j <= last;
    begun = begun && j == before;
    float begin = segmentBegin(ray, j);
    float end = segmentEnd(ray, j);
    float partBegin = begin + from * (end - begin);
    float partEnd = task == kEnd ? end : begin + at * (end - begin);
    vec3 place = coordinateOrigin + (begun ? partEnd : begin) * coordinateAlong;
    vec3 coordinate = coordinateOrigin + 0.5 * (partBegin + partEnd) * coordinateAlong;
#ifdef LABELS
    lookUpLabels(coordinate);
#endif
#ifdef PREINTEGRATED
    Side back = sideAt(place);
    vec2 look = vec2(back.value, back.valid);
#else
    vec2 look = volumeLookUp(place);
#endif
    look = !begun && j == firstOwned ? entryLook : look;
    look = begun && task == kEnd && j == lastOwned ? exitLook : look;

    bool sampled = visit && begun;
    int crossed = frontLook.y * look.y > 0.0 ? side ^ sideOf(look.x) : 0;
    bool isDone = sampled && task == kEnd && crossed == 0;
    bool isMedium = isDone || (sampled && task == kMeet);
    bool isSurface = sampled && task == kSurface;
#ifdef PREINTEGRATED
#ifdef INVALID_VOXELS
    vec2 middle = volumeLookUp(coordinate);
    bool counts = middle.y > 0.0;
    Side nearer = mended(front, middle.x);
    Side farther = mended(back, middle.x);
#else
    const bool counts = true;
    Side nearer = front;
    Side farther = back;
#endif
    bool visible = isSurface || (isMedium && classify(nearer, farther) && counts);
#else
    vec2 middle = volumeLookUp(coordinate);
    bool visible = isSurface || (isMedium && classify(middle.x) && middle.y > 0.0);
#endif
    if (visible) {
      vec3 colour;
      float extinction;
#ifdef PREINTEGRATED
      shade(coordinate, nearer, farther, toEye, isSurface ? met : -1, colour, extinction);
#else
      shade(coordinate, toEye, isSurface ? met : -1, colour, extinction);
#endif
#ifdef HALOS
      visible = extinction > 0.0;  // classify() cannot tell
#endif
      float opacity = isSurface
                          ? extinction
                          : opacityOf(extinction * (partEnd - partBegin) * ray.planeWorld);
      float weight = (1.0 - sum.a) * opacity;
      sum += vec4(colour * weight, weight);
    }
#ifdef COUNT_SAMPLES
    bool isLooked = sampled && task != kSurface;
    visited += uint(isLooked);
    shaded += uint(visible);
    inOccupied += uint(isLooked && isOccupied(skip, 0.5 * (begin + end)));
    leaps += uint(j != before);
#endif

    if (!sampled || isDone) {
#ifdef PREINTEGRATED
      front = back;
#endif
      frontLook = look;
      side = sideOf(look.x);
      from = 0.0;
      task = kEnd;
      begun = visit;
    } else if (task == kEnd) {
      met = firstMet(crossed, frontLook.x);
      low = vec2(from, frontLook.x - isoValues[met]);
      high = vec2(1.0, look.x - isoValues[met]);
      at = mix(low.x, high.x, zeroOfLine(low.y, high.y));
      kept = looks = 0;
      task = low.y == 0.0 ? kMeet : kSeek;
    } else if (task == kSeek) {
      // Illinois: the end that is kept twice counts half, or it might be kept for ever.
      vec2 guess = vec2(at, look.x - isoValues[met]);
      bool isLow = (guess.y >= 0.0) == ((side >> met & 1) != 0);
      high.y *= isLow && kept > 0 ? 0.5 : 1.0;
      low.y *= !isLow && kept < 0 ? 0.5 : 1.0;
      low = isLow ? guess : low;
      high = isLow ? high : guess;
      kept = isLow ? 1 : -1;
      at = mix(low.x, high.x, zeroOfLine(low.y, high.y));
      task = abs(at - guess.x) <= kSought || ++looks == kMostLooks ? kMeet : kSeek;
      // Voxels that are not valid lie between: there is no surface.
      task = look.y > 0.0 ? task : kEnd;
      side ^= look.y > 0.0 ? 0 : 1 << met;
    } else if (task == kMeet) {
#ifdef PREINTEGRATED
      front = back;
#endif
      frontLook = vec2(isoValues[met], 1.0);
      from = at;
      task = kSurface;
    } else {
      side ^= 1 << met;
      task = kEnd;
    }
    j += int(isDone);
    last = sum.a > sufficient ? j - 1 : last;
  }
  result = sum;
  addToCounters();
}
