// Layers that are surfaces: a ray meets one where the volume's value passes its iso-value. The generated
// program defines SURFACES, their number, and shade() with the number of a surface, or -1 for the media.
//
// A set of surfaces is an int with a bit for each. The side of a value is the set of those that it is
// inside of: value >= iso-value.

uniform float isoValue[SURFACES];  // as the volume's values
float isoValues[SURFACES];         // kept over the loop

// Before the loop over samples (see `one`).
void prepareSurfaces() {
  for (int i = 0; i < SURFACES; ++i) isoValues[i] = one * isoValue[i];
}

int sideOf(float value) {
  int side = 0;
  for (int i = 0; i < SURFACES; ++i) side |= value >= isoValues[i] ? 1 << i : 0;
  return side;
}

// Of the surfaces in the set, which is not empty: the one that is met first by a value that rises or falls
// all the way from `value`; the first one in the scene of those that are met together.
int firstMet(int surfaces, float value) {
  int first = 0;
  float least = kFar;
  for (int i = 0; i < SURFACES; ++i) {
    float distance = abs(isoValues[i] - value);
    bool isNearer = (surfaces >> i & 1) != 0 && distance < least;
    first = isNearer ? i : first;
    least = isNearer ? distance : least;
  }
  return first;
}

// Where, from 0 to 1, the line through f0 < 0 <= f1 (or the other way round) is 0.
float zeroOfLine(float f0, float f1) { return clamp(f0 / (f0 - f1), 0.0, 1.0); }

// Of the media alone.
#ifdef PREINTEGRATED
void shade(vec3 coordinate, Side front, Side back, vec3 toEye, out vec3 colour, out float extinction) {
  shade(coordinate, front, back, toEye, -1, colour, extinction);
}
#endif
