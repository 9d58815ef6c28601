#include "vessel_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::node {
namespace {

constexpr double kTrunkRadius = 0.055;
constexpr double kThinnest = 0.0095;
constexpr double kStepPerRadius = 0.55;  ///< centre-line steps, short against the kernel's support
constexpr glm::dvec3 kCentre{0.5, 0.52, 0.5};
constexpr glm::dvec3 kExtent{0.42, 0.42, 0.42};  ///< half axes of the region the tree fills

/// Uniform in [0, 1): a hash of a counter, the same on every machine.
double uniform(std::uint32_t& state) {
  state += 0x9e3779b9u;
  std::uint32_t x = state;
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  x ^= x >> 16;
  return x * 0x1p-32;
}

glm::dvec3 anyPerpendicular(const glm::dvec3& direction) {
  const glm::dvec3 helper = std::abs(direction.x) < 0.7 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
  return glm::normalize(glm::cross(direction, helper));
}

/// How far outside the region p lies: below 1 inside.
double regionRadius(const glm::dvec3& p) {
  return glm::length((p - kCentre) / kExtent);
}

/// ∫ (h² - τ²)² dτ from 0.
double kernelIntegral(double h2, double tau) {
  const double tau2 = tau * tau;
  return tau * (h2 * h2 - tau2 * (2.0 / 3.0 * h2 - 0.2 * tau2));
}

}  // namespace

struct VesselTree::Branch {
  glm::dvec3 start;
  glm::dvec3 direction;
  glm::dvec3 forkPlane;  ///< unit normal of the plane in which the parent forked
  double radius;
};

const VesselTree& VesselTree::instance() {
  static const VesselTree tree;
  return tree;
}

VesselTree::VesselTree() {
  std::uint32_t random = 20010813;
  const Branch trunk{{0.5, 0.0, 0.5}, {0, 1, 0}, {0, 0, 1}, kTrunkRadius};
  grow(trunk, random);
  sortIntoCells();
}

/// One branch as a gently bent chain of segments, then the two it forks into. Radii follow Murray's
/// law (r³ = r₁³ + r₂³), the thinner child turns away more, and successive forks lie in planes
/// about perpendicular to each other, as in vessels.
void VesselTree::grow(const Branch& branch, std::uint32_t& random) {
  const double length = branch.radius * (2.4 + 1.8 * uniform(random)) + 0.028;
  const int steps =
      std::max(2, static_cast<int>(std::ceil(length / (kStepPerRadius * branch.radius))));
  const double step = length / steps;
  const glm::dvec3 side = anyPerpendicular(branch.direction);
  const glm::dvec3 other = glm::cross(branch.direction, side);
  const double turn = 2 * std::numbers::pi * uniform(random);
  const glm::dvec3 bend =
      (side * std::cos(turn) + other * std::sin(turn)) * (1.2 * uniform(random));
  glm::dvec3 at = branch.start;
  glm::dvec3 direction = branch.direction;
  for (int i = 0; i < steps; ++i) {
    segments_.push_back({at, direction, step, branch.radius});
    at += direction * step;
    const double outside = regionRadius(at);
    const glm::dvec3 inward = glm::normalize(kCentre - at);
    const double steer = outside > 0.7 ? 5 * (outside - 0.7) : 0;
    const double wave = std::cos(std::numbers::pi * (i + 1) / steps);
    direction = glm::normalize(direction + (bend * wave + inward * steer) * (step / length));
  }
  if (branch.radius < kThinnest * 1.12 || regionRadius(at) > 1.15) return;

  const double share =
      0.5 + 0.32 * uniform(random);  // of the cubed radius that the wider one takes
  const double wide = branch.radius * std::cbrt(share);
  const double thin = branch.radius * std::cbrt(1 - share);
  const glm::dvec3 planeNormal =
      glm::normalize(branch.forkPlane - direction * glm::dot(branch.forkPlane, direction) +
                     1e-3 * anyPerpendicular(direction));
  const glm::dvec3 across = glm::cross(planeNormal, direction);
  const double wideAngle = 0.25 + 0.55 * (1 - share);
  const double thinAngle = 0.45 + 0.7 * share * (0.7 + 0.5 * uniform(random));
  const auto turned = [&](double angle) {
    return glm::normalize(direction * std::cos(angle) + across * std::sin(angle));
  };
  const glm::dvec3 nextPlane = glm::normalize(across + planeNormal * (0.8 * uniform(random) - 0.4));
  if (wide > kThinnest) grow({at, turned(wideAngle), nextPlane, wide}, random);
  if (thin > kThinnest) grow({at, turned(-thinAngle), nextPlane, thin}, random);
}

bool VesselTree::touches(const Segment& segment, const glm::ivec3& cell) const {
  constexpr double kHalfDiagonal = 0.8660254037844387 / kCells;
  const glm::dvec3 centre = (glm::dvec3{cell} + 0.5) / static_cast<double>(kCells);
  const double along =
      std::clamp(glm::dot(centre - segment.start, segment.direction), 0.0, segment.length);
  const glm::dvec3 nearest = segment.start + along * segment.direction;
  return glm::distance(centre, nearest) <= segment.radius + kHalfDiagonal;
}

/// A list of segments for each cell of a coarse grid, so that a look-up meets only its neighbours.
void VesselTree::sortIntoCells() {
  std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(kCells) * kCells * kCells);
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    const Segment& segment = segments_[s];
    const glm::dvec3 end = segment.start + segment.direction * segment.length;
    const auto cellOf = [](const glm::dvec3& p) {
      return glm::clamp(glm::ivec3{glm::floor(p * static_cast<double>(kCells))}, glm::ivec3{0},
                        glm::ivec3{kCells - 1});
    };
    const glm::ivec3 lo = cellOf(glm::min(segment.start, end) - segment.radius);
    const glm::ivec3 hi = cellOf(glm::max(segment.start, end) + segment.radius);
    for (int z = lo.z; z <= hi.z; ++z) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int x = lo.x; x <= hi.x; ++x) {
          if (!touches(segment, {x, y, z})) continue;
          lists[static_cast<std::size_t>((z * kCells + y) * kCells + x)].push_back(s);
        }
      }
    }
  }
  cellStart_.push_back(0);
  for (const auto& list : lists) {
    cellSegments_.insert(cellSegments_.end(), list.begin(), list.end());
    cellStart_.push_back(static_cast<std::uint32_t>(cellSegments_.size()));
  }
}

double VesselTree::field(const glm::dvec3& p) const {
  const auto cellIndex = [](double x) {
    return std::clamp(static_cast<int>(x * kCells), 0, kCells - 1);
  };
  const auto cell = static_cast<std::size_t>((cellIndex(p.z) * kCells + cellIndex(p.y)) * kCells +
                                             cellIndex(p.x));
  double sum = 0;
  for (std::uint32_t at = cellStart_[cell]; at < cellStart_[cell + 1]; ++at) {
    const Segment& segment = segments_[cellSegments_[at]];
    const glm::dvec3 toPoint = p - segment.start;
    const double along = glm::dot(toPoint, segment.direction);
    const double radius2 = segment.radius * segment.radius;
    const double h2 = radius2 - (glm::dot(toPoint, toPoint) - along * along);
    if (h2 <= 0) continue;
    // The part of the segment inside the kernel's ball, seen from the foot of the perpendicular.
    const double h = std::sqrt(h2);
    const double from = std::max(-along, -h);
    const double to = std::min(segment.length - along, h);
    if (from >= to) continue;
    const double scale = 15.0 / (16.0 * radius2 * radius2 * segment.radius);
    sum += scale * (kernelIntegral(h2, to) - kernelIntegral(h2, from));
  }
  return sum;
}

}  // namespace burin::node
