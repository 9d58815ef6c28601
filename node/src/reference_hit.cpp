#include "reference_hit.hpp"

namespace burin::node {

std::optional<double> referenceHit(const ValueAtDepth& value, double isoValue, double begin,
                                   double end) {
  const std::optional<double> first = value(begin);
  const std::optional<double> last = value(end);
  if (!first || !last) return std::nullopt;
  const bool isInsideBefore = *first >= isoValue;
  if (isInsideBefore == (*last >= isoValue)) return std::nullopt;
  double before = begin;
  double behind = end;
  for (;;) {
    const double middle = before + (behind - before) / 2;
    if (!(before < middle && middle < behind)) return behind;
    const std::optional<double> there = value(middle);
    if (!there) return std::nullopt;
    (((*there >= isoValue) == isInsideBefore) ? before : behind) = middle;
  }
}

}  // namespace burin::node
