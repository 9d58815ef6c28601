#include "reference_projection.hpp"

#include <algorithm>

namespace burin::node {

ColourAndOpacity ReferenceProjection::of(const Values& values) const {
  if (values.empty()) return {glm::dvec3{0}, 0};
  if (!isMean_)
    return transferFunction_.lookUp(std::ranges::max_element(values, {}, &Value::value)->value);
  double sum = 0;
  double length = 0;
  for (const Value& at : values) {
    sum += at.value * at.length;
    length += at.length;
  }
  return transferFunction_.lookUp(sum / length);
}

}  // namespace burin::node
