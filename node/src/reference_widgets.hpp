#pragma once

#include "burin/common/transfer_function.hpp"

namespace burin::node {

/// A two-dimensional transfer function over the values of a segment, by quadrature of the exact
/// function in double.
class ReferenceWidgets {
 public:
  ReferenceWidgets(const TransferFunction& function, double unitLength)
      : function_{function}, unitLength_{unitLength} {}

  /// The mean extinction over the values between `a` and `b` (either order), each as likely as the
  /// other, at m = `magnitude`, and their mean colour weighted by extinction.
  Classified between(double a, double b, double magnitude) const;

 private:
  TransferFunction function_;
  double unitLength_;
};

}  // namespace burin::node
