#include "burin/common/transfer_widget.hpp"

#include <algorithm>
#include <cmath>

namespace burin {

namespace {

glm::dvec2 centreAndHalf(const glm::dvec2& range) {
  return {range.x / 2 + range.y / 2, range.y / 2 - range.x / 2};
}

}  // namespace

double TransferWidget::valueFalloffUsed() const {
  return valueFalloff.value_or(shape == WidgetShape::kTriangle ? 1.0 : 0.25);
}

glm::dvec2 TransferWidget::valueRange() const {
  if (shape != WidgetShape::kTriangle) return value;
  const double tip = apex.value_or(centreAndHalf(value).x);
  return {std::min(value.x, tip), std::max(value.y, tip)};
}

glm::dvec2 TransferWidget::edgesAt(double magnitude) const {
  const glm::dvec2 across = centreAndHalf(value);
  if (shape == WidgetShape::kEllipse) {
    const glm::dvec2 up = centreAndHalf(gradient);
    const double height = (magnitude - up.x) / up.y;
    const double reach = across.y * std::sqrt(std::max(0.0, 1 - height * height));
    return {across.x - reach, across.x + reach};
  }
  if (shape == WidgetShape::kRectangle) return value;
  const double tip = apex.value_or(across.x);
  const double part = magnitude / gradient.y;
  return {tip + part * (value.x - tip), tip + part * (value.y - tip)};
}

double TransferWidget::weightOfMagnitude(double magnitude) const {
  const double fall = gradientFalloffUsed() * (gradient.y - gradient.x) / 2;
  const bool hasLower = shape == WidgetShape::kTriangle || gradient.x > 0;
  const double lower = hasLower ? std::clamp((magnitude - gradient.x) / fall, 0.0, 1.0) : 1.0;
  const double upper = gradient.y < 1 ? std::clamp((gradient.y - magnitude) / fall, 0.0, 1.0) : 1.0;
  return std::min(lower, upper);
}

double TransferWidget::weight(double dataValue, double magnitude) const {
  if (shape == WidgetShape::kEllipse) {
    const glm::dvec2 across = centreAndHalf(value);
    const glm::dvec2 up = centreAndHalf(gradient);
    const double u = (dataValue - across.x) / across.y;
    const double w = (magnitude - up.x) / up.y;
    const double inside = std::max(0.0, 1 - u * u - w * w);
    return inside * inside;
  }
  const double share = weightOfMagnitude(magnitude);
  if (!(share > 0)) return 0;  // at a triangle's apex there are no edges
  const glm::dvec2 edges = edgesAt(magnitude);
  const double fall = valueFalloffUsed() * (edges.y - edges.x) / 2;
  const double inside = std::min(dataValue - edges.x, edges.y - dataValue);
  return share * std::clamp(inside / fall, 0.0, 1.0);
}

}  // namespace burin
