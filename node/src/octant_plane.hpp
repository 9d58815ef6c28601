#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "macrocell_ranges.hpp"

namespace burin::node {

/// Ranges of a row of octants along x.
struct OctantRow {
  std::vector<float> lowest, highest;

  ValueRange at(std::size_t x) const { return {lowest[x], highest[x]}; }
};

/// The extremes of the octants of equal z while their voxels arrive.
class OctantPlane {
 public:
  /// `octants`: along x and y.
  explicit OctantPlane(const glm::ivec2& octants);

  /// A row of voxels of the octants (·, y): their extremes for each of these.
  void add(int y, const OctantRow& voxels);

  /// The ranges of the octants (·, y), as wide as look-ups may go beyond them, into `row`.
  /// `before`, `behind`: the planes next to this one along z, if there are any.
  void widenedRow(int y, const OctantPlane* before, const OctantPlane* behind,
                  OctantRow& row) const;

 private:
  void takeRow(int y, OctantRow& row) const;

  std::size_t width_;
  int rows_;
  std::vector<float> lowest_, highest_;  ///< x fastest; lowest > highest where no voxel is finite
};

}  // namespace burin::node
