// The eight voxels around a sample, for what happens at voxels and is then filtered: quantised normals,
// and palettes before filtering. Filtering is trilinear, by weights computed here.

struct Cell {
  vec3 lowest;  // the voxel of smallest index, counted from the texture's corner
  vec3 weight;  // of the voxels of larger index
};

Cell cellAt(vec3 coordinate) {
  vec3 voxel = coordinate / texelSize - 0.5;
  vec3 lowest = floor(voxel);
  return Cell(lowest, voxel - lowest);
}

vec3 cornerOffset(int corner) { return vec3(corner & 1, (corner >> 1) & 1, corner >> 2); }

// A voxel's coordinate in the texture.
vec3 cornerCoordinate(Cell cell, int corner) {
  return (cell.lowest + cornerOffset(corner) + 0.5) * texelSize;
}

float cornerShare(Cell cell, int corner) {
  vec3 share = mix(1.0 - cell.weight, cell.weight, cornerOffset(corner));
  return share.x * share.y * share.z;
}
