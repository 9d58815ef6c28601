// What every march along a ray begins with. Included by raycast.glsl, which has sufficientOpacity().
//
// The driver moves nothing out of loops, evaluates both sides of every branch and the body of every
// loop at least once. So what a march's loop needs is computed here, it has no loops inside, and each
// round looks at the macrocell of the next segment and up the volume as often as any round does.

float sufficient;                        // sufficientOpacity()
vec3 coordinateOrigin, coordinateAlong;  // the ray's texture coordinate: on plane 0, and per plane
vec3 toEye;                              // unit, world

// The brick's segments on the pixel's ray, from j to `last`; false if nothing of them is to be drawn.
bool beginMarch(out Ray ray, out int j, out int last, out SkipState skip) {
  sufficient = sufficientOpacity();
  if (sufficient <= 0.0) return false;
  ray = pixelRay();
  if (!ownedSegments(ray, j, last)) return false;
  skip = beginSkipping(ray, j);
  prepareVolume();
  prepareLights();
  prepareLayers();
  coordinateOrigin = textureCoordinate(ray.origin);
  coordinateAlong = ray.along * texelSize;
  toEye = directionToEye();
  return true;
}
