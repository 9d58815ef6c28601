#pragma once

#include <vector>

#include "burin/common/scene.hpp"

namespace burin::node {

/// A layer that is one value per ray: the largest of its samples', or their mean by length.
class ReferenceProjection {
 public:
  /// A sample's value and the length it stands for.
  struct Value {
    double value;
    double length;
  };
  using Values = std::vector<Value>;

  explicit ReferenceProjection(const Layer& layer)
      : transferFunction_{layer.transferFunction}, isMean_{layer.mode == LayerMode::kAverage} {}

  /// Of the samples of a ray; nothing for none.
  ColourAndOpacity of(const Values& values) const;

 private:
  TransferFunction transferFunction_;
  bool isMean_;
};

}  // namespace burin::node
