#pragma once

#include <vector>

#include "burin/common/scene.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// Means of the extinction that all of a scene's transferFunctions() have together, over ranges of
/// values, from sums over bins. Good enough for estimates.
class ExtinctionMeans {
 public:
  /// `scene`: resolved.
  ExtinctionMeans(const Scene& scene, const ValueScale& scale);

  /// Per world unit, over [lowest, highest]; stored values.
  float operator()(float lowest, float highest) const;

 private:
  double below(double position) const;  ///< sum of the bins below; position in bins

  double first_ = 0;         ///< stored value where the bins begin
  double binsPerValue_ = 1;  ///< bins per unit of stored value
  std::vector<double> sums_;
};

}  // namespace burin::node
