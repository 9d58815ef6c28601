#include "reference_halo.hpp"

#include <algorithm>
#include <cmath>

#include "reference_blend.hpp"

namespace burin::node {

ReferenceHalo::ReferenceHalo(const Layer& layer, double gradientScale, double noiseFloor)
    : features_{layer.transferFunction},
      unitLength_{features_.opacityUnitLength.value()},
      gradientScale_{gradientScale},
      noiseFloor_{noiseFloor} {
  const StyleSettings& settings = *layer.style("halo");
  around_ = haloNeighbourhood(settings);
  strength_ = settings.number("strength");
  directionPower_ = settings.number("direction_power");
  edgePower_ = settings.number("edge_power");
  colour_ = settings.colour("color").linear();
  if (const StyleSettings* gradient = layer.style("gradient"))
    isInward_ = gradient->word("normal") == "inward";
}

double ReferenceHalo::castOn(const glm::dvec3& world, const ReferenceVolume& volume,
                             const ReferenceView& view) const {
  const double radius = around_.radius * volume.grid().smallestSpacing();
  double sum = 0;
  for (int i = 0; i < 6; ++i) {
    const double angle = glm::radians(60.0 * i);
    const glm::dvec3 towards =
        std::cos(angle) * view.extent.right() + std::sin(angle) * view.extent.up();
    sum += castBy(world - radius * towards, towards, volume, view);
  }
  return std::min(sum / 1.5, 1.0);
}

/// `towards`: the unit direction from the neighbour to where the halo is.
double ReferenceHalo::castBy(const glm::dvec3& neighbour, const glm::dvec3& towards,
                             const ReferenceVolume& volume, const ReferenceView& view) const {
  const VolumeGrid& grid = volume.grid();
  const double aside = around_.aside * grid.smallestSpacing();
  const auto valueAt = [&](const glm::dvec3& world) {
    return volume.valueAt(volume.indexFromWorld(world));
  };
  // First, as most neighbours end here.
  const auto inside = valueAt(neighbour - aside * towards);
  if (!inside) return 0;
  const double opacity =
      -std::expm1(-features_.classify(*inside, unitLength_).extinction * unitLength_);
  if (opacity <= 0) return 0;
  const glm::dvec3 back = glm::cross(view.extent.right(), view.extent.up());
  glm::dvec3 gradient{0};
  for (const glm::dvec3& axis : {towards, glm::cross(back, towards), back}) {
    const auto ahead = valueAt(neighbour + aside * axis);
    const auto behind = valueAt(neighbour - aside * axis);
    if (!ahead || !behind) return 0;
    gradient += (*ahead - *behind) / (2 * aside) * axis;
  }
  const double steepness = glm::length(gradient);
  if (!(steepness > 0) || !(gradientScale_ > 0)) return 0;
  const glm::dvec3 normal = (isInward_ ? 1.0 : -1.0) * gradient / steepness;
  const double m = std::min(steepness / gradientScale_, 1.0);
  const double edge = std::max(1 - std::abs(glm::dot(normal, view.toEye)), 0.0) *
                      smoothstep(noiseFloor_, 2 * noiseFloor_, m);
  return opacity * m * std::pow(std::max(glm::dot(normal, towards), 0.0), directionPower_) *
         std::pow(edge, edgePower_);
}

Classified ReferenceHalo::over(const Classified& sample, double cast, double m) const {
  const double own = strength_ / unitLength_ * (1 - m) * cast;
  const double both = sample.extinction + own;
  if (!(both > 0)) return sample;
  return {.colour = blend(sample.colour, colour_, own / both), .extinction = both};
}

}  // namespace burin::node
