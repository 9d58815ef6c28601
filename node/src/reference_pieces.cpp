#include "reference_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace burin::node {
namespace {

/// Appends where the ray crosses planes of voxels inside the interval.
void addFaces(std::vector<double>& depths, double origin, double direction,
              const DepthInterval& interval) {
  if (direction == 0) return;
  const double a = origin + interval.near * direction;
  const double b = origin + interval.far * direction;
  for (double plane = std::ceil(std::min(a, b)); plane <= std::max(a, b); ++plane) {
    const double depth = (plane - origin) / direction;
    if (depth > interval.near && depth < interval.far) depths.push_back(depth);
  }
}

/// Where the derivative of the cubic through values at 0, 1/3, 2/3 and 1 vanishes, ascending; NaN
/// where it does not.
std::array<double, 2> extremes(const std::array<double, 4>& v) {
  // c1 + 2 c2 t + 3 c3 t² from the differences at equal distances (Newton's form).
  const double d1 = v[1] - v[0];
  const double d2 = v[2] - 2 * v[1] + v[0];
  const double d3 = v[3] - 3 * v[2] + 3 * v[1] - v[0];
  const double c1 = 3 * d1 - 1.5 * d2 + d3;
  const double c2 = 4.5 * (d2 - d3);
  const double c3 = 4.5 * d3;
  const double root = std::sqrt(c2 * c2 - 3 * c1 * c3);
  // The form without cancellation; c3 = 0 leaves -c1 / (2 c2) and an infinity.
  const double q = -(c2 + std::copysign(root, c2));
  const double t = q / (3 * c3);
  const double s = c1 / q;
  return {std::min(t, s), std::max(t, s)};
}

void addExtremes(std::vector<double>& depths, const ReferenceVolume& volume,
                 const glm::dvec3& origin, const glm::dvec3& direction, double begin, double end) {
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double depth = begin + (end - begin) * static_cast<double>(i) / 3;
    const std::optional<double> value = volume.valueAt(origin + depth * direction);
    if (!value) return;
    values[i] = *value;
  }
  for (const double t : extremes(values))
    if (t > 0 && t < 1) depths.push_back(begin + t * (end - begin));
}

}  // namespace

std::vector<double> smoothPieces(const ReferenceVolume& volume, const glm::dvec3& origin,
                                 const glm::dvec3& direction, const DepthInterval& interval) {
  std::vector<double> faces{interval.near, interval.far};
  for (int axis = 0; axis < 3; ++axis) addFaces(faces, origin[axis], direction[axis], interval);
  std::ranges::sort(faces);
  std::vector<double> depths;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (!(faces[i] < faces[i + 1])) continue;
    depths.push_back(faces[i]);
    addExtremes(depths, volume, origin, direction, faces[i], faces[i + 1]);
  }
  depths.push_back(interval.far);
  return depths;
}

}  // namespace burin::node
