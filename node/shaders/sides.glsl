// The ends of pre-integrated segments; after the generated classifySide().

Side sideAt(vec3 coordinate) {
  vec2 look = volumeLookUp(coordinate);
  Side side;
  side.value = look.x;
  side.valid = look.y;
  classifySide(side);
  return side;
}

#ifdef INVALID_VOXELS
// An end in voxels that are not valid counts as the middle does.
Side mended(Side side, float middle) {
  Side other;
  other.value = middle;
  other.valid = 1.0;
  classifySide(other);
  if (side.valid > 0.0) return side;
  return other;
}
#endif
