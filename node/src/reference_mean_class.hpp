#pragma once

#include <vector>

#include "burin/common/transfer_function.hpp"

namespace burin::node {

/// What a transfer function says about all values between two, each as likely as the other, by
/// quadrature of the exact function in double.
class ReferenceMeanClass {
 public:
  ReferenceMeanClass(const TransferFunction& function, double unitLength);

  /// The mean extinction between `a` and `b` (either order), and the mean colour weighted by
  /// extinction (0 where there is none).
  Classified between(double a, double b) const;

 private:
  TransferFunction function_;
  double unitLength_;
  std::vector<double> cuts_;  ///< values between which the function is smooth
};

}  // namespace burin::node
