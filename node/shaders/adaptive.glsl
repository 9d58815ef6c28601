// The march of raycast.glsl for a largest error instead of a step. Included by raycast.glsl, for
// pre-integrated classification.
//
// A stretch of a ray is divided until dividing it once more changes its colour and opacity by no more
// than `tolerance`. Where values of the volume are looked up on the way depends on how much may hide
// between look-ups: cells.glsl for steep transfer functions, halving.glsl for the others.
//
// The parts of a stretch are the nodes of a binary tree, walked from front to back. Whether one is halved
// depends on its own values, neither on what lies before it nor on the brick.

uniform float tolerance;  // of premultiplied colour and opacity, for one part

// A stretch's smallest parts; their halves are looked at.
#ifdef INVALID_VOXELS
const uint kUnits = 8192u;  // as fine as the ends of what is valid are found
#else
const uint kUnits = 512u;
#endif

// A part's premultiplied colour and opacity. `world`: its length. A part of which one end lies in
// voxels that are not valid is nothing.
vec4 partColour(vec3 coordinate, Side from, Side to, vec3 toEye, float world) {
  vec3 colour;
  float extinction;
#ifdef LABELS
  lookUpLabels(coordinate);
#endif
  if (from.valid * to.valid == 0.0 || !classify(from, to)) return vec4(0.0);
  shade(coordinate, from, to, toEye, colour, extinction);
  float opacity = opacityOf(extinction * world);
  return vec4(colour * opacity, opacity);
}

// Whether voxels that are not valid begin within a part: it is halved down to where.
bool meetsInvalid(Side front, Side middle, Side back) {
#ifdef INVALID_VOXELS
  return front.valid != middle.valid || middle.valid != back.valid;
#else
  return false;
#endif
}

float largestDifference(vec4 a, vec4 b) {
  vec4 change = abs(a - b);
  return max(max(change.r, change.g), max(change.b, change.a));
}

// Units of the node of the tree that begins where `done` units end.
uint nodeAfter(uint done) { return done == 0u || done >= kUnits ? kUnits : done & (~done + 1u); }

#ifdef SURFACES
// The surfaces of a set, all met at one place, one behind the other; premultiplied.
vec4 surfaceColours(vec3 coordinate, Side at, int surfaces, vec3 toEye) {
  vec4 sum = vec4(0.0);
  while (surfaces != 0) {
    int met = firstMet(surfaces, at.value);
    vec3 colour;
    float opacity;
    shade(coordinate, at, at, toEye, met, colour, opacity);
    sum += (1.0 - sum.a) * vec4(colour * opacity, opacity);
    surfaces ^= 1 << met;
  }
  return sum;
}
#endif

#ifdef STEEP
#include "cells.glsl"
#else
#include "halving.glsl"
#endif
