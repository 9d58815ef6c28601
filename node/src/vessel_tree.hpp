#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace burin::node {

/// A branching tree of smooth tubes in the unit cube, the same on every machine. Its field is the
/// convolution of the tree's centre lines with a kernel of compact support, so that joints and
/// forks blend without creases: around a straight tube of radius R it is (1 - d²/R²)^(5/2) at
/// distance d from the centre line.
class VesselTree {
 public:
  /// Grown on first use.
  static const VesselTree& instance();

  /// The field at p in the unit cube: 0 away from the tubes, about 1 on their centre lines, up to
  /// about 2 in forks. Twice continuously differentiable in space.
  double field(const glm::dvec3& p) const;

  std::size_t segmentCount() const { return segments_.size(); }

 private:
  struct Segment {
    glm::dvec3 start;
    glm::dvec3 direction;  ///< unit
    double length;
    double radius;  ///< of the kernel's support
  };
  struct Branch;

  VesselTree();
  void grow(const Branch& branch, std::uint32_t& random);
  void sortIntoCells();
  bool touches(const Segment& segment, const glm::ivec3& cell) const;

  static constexpr int kCells = 64;  ///< per axis; a cell is a little wider than the thinnest tube
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> cellStart_;  ///< where a cell's list begins in cellSegments_
  std::vector<std::uint32_t> cellSegments_;
};

}  // namespace burin::node
