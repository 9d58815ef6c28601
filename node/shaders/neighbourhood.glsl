// Differences of the trilinear field at p + o and p - o for the 13 pairs of opposite neighbours o in
// 3×3×3 voxels, for gradient operators that weigh more than the six faces. At a voxel they are those of
// the voxels; in between that is the voxels' gradients, interpolated.

struct Neighbourhood {
  vec3 faces, edges, corners;  // sums of o * difference, by how many components of o are not 0
  float facesValid, valid;     // 1 if all look-ups that count are, else 0
};

void addPair(vec3 coordinate, vec3 offset, inout vec3 sum, inout float valid) {
  vec3 away = offset * texelSize;
  vec2 above = GRADIENT_LOOK_UP(coordinate + away);
  vec2 below = GRADIENT_LOOK_UP(coordinate - away);
  sum += offset * (above.x - below.x);
  valid *= above.y * below.y;
}

Neighbourhood neighbourhoodAt(vec3 at) {
  Neighbourhood n = Neighbourhood(vec3(0.0), vec3(0.0), vec3(0.0), 1.0, 1.0);
  addPair(at, vec3(1.0, 0.0, 0.0), n.faces, n.facesValid);
  addPair(at, vec3(0.0, 1.0, 0.0), n.faces, n.facesValid);
  addPair(at, vec3(0.0, 0.0, 1.0), n.faces, n.facesValid);
  addPair(at, vec3(1.0, 1.0, 0.0), n.edges, n.valid);
  addPair(at, vec3(1.0, -1.0, 0.0), n.edges, n.valid);
  addPair(at, vec3(1.0, 0.0, 1.0), n.edges, n.valid);
  addPair(at, vec3(1.0, 0.0, -1.0), n.edges, n.valid);
  addPair(at, vec3(0.0, 1.0, 1.0), n.edges, n.valid);
  addPair(at, vec3(0.0, 1.0, -1.0), n.edges, n.valid);
  addPair(at, vec3(1.0, 1.0, 1.0), n.corners, n.valid);
  addPair(at, vec3(1.0, 1.0, -1.0), n.corners, n.valid);
  addPair(at, vec3(1.0, -1.0, 1.0), n.corners, n.valid);
  addPair(at, vec3(1.0, -1.0, -1.0), n.corners, n.valid);
  n.valid *= n.facesValid;
  return n;
}

// As volumeDifferences(). `weights`: of faces, edges and corners.
vec3 weighted(Neighbourhood n, vec3 weights) {
  return n.valid * (weights.x * n.faces + weights.y * n.edges + weights.z * n.corners);
}
