#pragma once

#include <span>
#include <vector>

#include "burin/common/scene.hpp"
#include "transfer_table.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// One table for each of the scene's transferFunctions(), over the volume's values.
std::vector<TransferTable> transferTables(const Scene& scene, const ValueScale& scale);

/// Which stored values any layer of a scene shows: disjoint intervals, so that asking about a range
/// of values takes no look at the transfer functions' points. Open at ends where the function is 0;
/// widened elsewhere by one bin of the layer's table, whose look-up may round into the next one.
class VisibleValues {
 public:
  VisibleValues() = default;  ///< none
  /// `tables`: transferTables() of the scene.
  VisibleValues(const Scene& scene, std::span<const TransferTable> tables, const ValueScale& scale);

  /// Whether a value of [lowest, highest] may be seen; stored values.
  bool any(float lowest, float highest) const {
    for (const Interval& interval : intervals_)
      if (lowest < interval.highest && highest > interval.lowest) return true;
    return false;
  }

  /// Whether the same holds of every part of that range.
  bool all(float lowest, float highest) const {
    for (const Interval& interval : intervals_)
      if (lowest > interval.lowest && highest < interval.highest) return true;
    return false;
  }

  /// How many cubes of that many cells a scene may show something beyond those that hold visible
  /// values.
  int reach(int cubeCells) const;

 private:
  struct Interval {
    float lowest, highest;
  };

  std::vector<Interval> intervals_;  ///< ascending
  double reach_ = 0;                 ///< voxels
};

}  // namespace burin::node
