#include "reference_layer.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "reference_blend.hpp"

namespace burin::node {
namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3{0};
}

/// e = (1 - |n·v|) q(m).
double edgeMeasure(const ReferenceFacing& at, const ReferenceView& view) {
  return std::max(0.0, 1 - std::abs(glm::dot(at.normal, view.toEye))) * at.confidence;
}

}  // namespace

ReferenceLayer::ReferenceLayer(const Layer& layer, ReferenceGradientScale& scale)
    : transferFunction_{layer.transferFunction},
      unitLength_{transferFunction_.opacityUnitLength.value()},
      means_{transferFunction_, unitLength_},
      isoValue_{layer.isoValue},
      labels_{layer.labels},
      isoOpacity_{layer.isoOpacity} {
  if (transferFunction_.isTwoDimensional()) widgets_.emplace(transferFunction_, unitLength_);
  if (!layer.lineOpacity.empty()) {
    lineFunction_.emplace();
    for (const OpacityPoint& point : layer.lineOpacity)
      lineFunction_->points.push_back({point.value, {}, point.opacity});
    lineMeans_.emplace(*lineFunction_, unitLength_);
  }
  readExtinctionStyles(layer);
  readColourStyles(layer);
  readLineStyles(layer);
  if (needsGradient() || layer.style("halo") != nullptr) readGradientSettings(layer, scale);
  if (layer.style("halo") != nullptr) halo_.emplace(layer, gradientScale_, noiseFloor_);
}

bool ReferenceLayer::needsGradient() const {
  return widgets_ || surface_ || boundary_ || silhouette_ || light_ || tone_ || toon_ || edges_ ||
         specular_ || lineSurface_ || halo_;
}

ReferenceLayer::Direction ReferenceLayer::directionOf(const StyleSettings& settings) {
  return {settings.word("along") == "view", settings.direction("axis")};
}

ReferenceLayer::Enhancement ReferenceLayer::enhancementOf(const StyleSettings& settings) {
  return {settings.number("constant"), settings.number("scale"), settings.number("exponent")};
}

void ReferenceLayer::readExtinctionStyles(const Layer& layer) {
  if (const auto* s = layer.style("surface")) surface_ = s->curve("opacity");
  if (const auto* s = layer.style("boundary")) boundary_ = enhancementOf(*s);
  if (const auto* s = layer.style("silhouette")) silhouette_ = enhancementOf(*s);
  if (const auto* s = layer.style("fade")) fade_ = Fade{directionOf(*s), s->curve("opacity")};
}

void ReferenceLayer::readColourStyles(const Layer& layer) {
  if (const auto* s = layer.style("light"))
    light_ = Lit{s->number("ambient"), s->number("diffuse"), s->number("normal_color")};
  if (const auto* s = layer.style("tone")) tone_.emplace(*s);
  if (const auto* s = layer.style("toon"))
    toon_ = Toon{s->number("tones"), s->number("strength"), s->number("softness")};
  if (const auto* s = layer.style("depth"))
    depth_ = Depth{directionOf(*s),      s->word("mode") == "distance", s->colourCurve("factor"),
                   s->curve("blend"),    s->colour("color").linear(),   s->number("strength"),
                   s->number("exponent")};
  if (const auto* s = layer.style("laplacian"))
    laplacian_ = Laplacian{s->number("above"), s->number("below"), s->number("softness"),
                           s->number("strength"), s->colour("color").linear()};
}

void ReferenceLayer::readLineStyles(const Layer& layer) {
  if (const auto* s = layer.style("edges"))
    edges_ = Edges{s->number("strength"), s->number("threshold"), s->number("power"),
                   s->colour("color").linear()};
  if (const auto* s = layer.style("specular"))
    specular_ = Specular{s->number("strength"), s->number("exponent")};
  if (const auto* s = layer.style("line_surface")) lineSurface_ = s->curve("opacity");
}

void ReferenceLayer::readGradientSettings(const Layer& layer, ReferenceGradientScale& scale) {
  const StyleSpec* spec = findStyle("gradient");
  BURIN_CHECK(spec != nullptr);
  const auto* chosen = layer.style("gradient");
  const StyleSettings settings = chosen != nullptr ? *chosen : defaultSettings(*spec);
  noiseFloor_ = settings.number("noise_floor");
  const std::string& normal = settings.word("normal");
  orientation_ = normal == "inward"   ? Orientation::kInward
                 : normal == "facing" ? Orientation::kFacing
                                      : Orientation::kOutward;
  operator_ = gradientOperator(layer);
  gradientScale_ = settings.word("magnitude") == "maximum" ? scale.maximum(operator_)
                                                           : scale.percentile(operator_);
}

ReferenceClass ReferenceLayer::classify(double value) const {
  const Classified plain = transferFunction_.classify(value, unitLength_);
  if (!lineFunction_) return {plain, plain.extinction};
  return {plain, lineFunction_->classify(value, unitLength_).extinction};
}

ReferenceClass ReferenceLayer::classify(double front, double back) const {
  const Classified mean = means_.between(front, back);
  if (!lineFunction_) return {mean, mean.extinction};
  // Where only lines show, a mean weighted by the layer's own extinction says no colour.
  const double middle = front + (back - front) / 2;
  return {{transferFunction_.classify(middle, unitLength_).colour, mean.extinction},
          lineMeans_->between(front, back).extinction};
}

ReferenceClass ReferenceLayer::classify(double front, double back,
                                        const glm::dvec3& gradient) const {
  const Classified mean = widgets_->between(front, back, magnitudeOf(gradient));
  if (!lineFunction_) return {mean, mean.extinction};
  return {mean, lineMeans_->between(front, back).extinction};
}

ReferenceClass ReferenceLayer::isoClass() const {
  const double value = isoValue_.value();
  const Classified plain{transferFunction_.lookUp(value).colour, isoOpacity_};
  return {plain, lineFunction_ ? lineFunction_->lookUp(value).opacity : isoOpacity_};
}

Classified ReferenceLayer::shade(const ReferenceClass& classes, const ReferencePlace& place,
                                 const ReferenceView& view) const {
  const ReferenceFacing at = needsGradient() ? facing(place.gradient, view) : ReferenceFacing{};
  const ReferenceFacing lightSees = cutThrough(at, place.cut, view);
  Classified sample = classes.plain;
  if (surface_) sample.extinction *= surface_->at(at.magnitude);
  if (boundary_) sample.extinction *= boundary_->at(at.magnitude);
  if (silhouette_) sample.extinction *= silhouette_->at(edgeMeasure(at, view));
  const double faded =
      fade_ ? fade_->opacity.at(fade_->direction.position(place.world, view)) : 1.0;
  sample.extinction *= faded;
  if (light_) sample.colour = lit(sample.colour, lightSees, view);
  if (tone_) sample.colour = tone_->apply(sample.colour, lightSees, view);
  if (toon_) sample.colour = tooned(sample.colour, lightSees, view);
  if (depth_) sample.colour = distant(sample.colour, place.world, view);
  if (laplacian_) sample.colour = creased(sample.colour, place.laplacian);
  if (halo_) sample = halo_->over(sample, place.halo, at.magnitude);
  if (!classes.shows()) return sample;  // no lines either
  const double lineFactor = faded * (lineSurface_ ? lineSurface_->at(at.magnitude) : 1.0);
  if (edges_ || specular_) drawLines(sample, classes.lineExtinction, lineFactor, at, view);
  return sample;
}

double ReferenceLayer::Enhancement::at(double x) const {
  return constant + scale * std::pow(x, exponent);
}

double ReferenceLayer::Direction::position(const glm::dvec3& world,
                                           const ReferenceView& view) const {
  return byView ? view.extent.depth(world) : view.extent.along(world, axis);
}

double ReferenceLayer::magnitudeOf(const glm::dvec3& gradient) const {
  return gradientScale_ > 0 ? std::min(glm::length(gradient) / gradientScale_, 1.0) : 0.0;
}

ReferenceFacing ReferenceLayer::facing(const glm::dvec3& gradient,
                                       const ReferenceView& view) const {
  ReferenceFacing at;
  at.magnitude = magnitudeOf(gradient);
  at.confidence = smoothstep(noiseFloor_, 2 * noiseFloor_, at.magnitude);
  at.normal = orientedNormal(unitOrZero(gradient), view);
  return at;
}

glm::dvec3 ReferenceLayer::orientedNormal(const glm::dvec3& inward,
                                          const ReferenceView& view) const {
  const bool flip = orientation_ == Orientation::kOutward ||
                    (orientation_ == Orientation::kFacing && glm::dot(inward, view.toEye) < 0);
  return flip ? -inward : inward;
}

ReferenceFacing ReferenceLayer::cutThrough(const ReferenceFacing& at, const ReferenceCut& cut,
                                           const ReferenceView& view) const {
  ReferenceFacing surface = at;
  surface.normal =
      unitOrZero(blend(at.confidence * at.normal, orientedNormal(cut.inward, view), cut.share));
  surface.confidence = blend(at.confidence, 1.0, cut.share);
  return surface;
}

glm::dvec3 ReferenceLayer::lit(const glm::dvec3& colour, const ReferenceFacing& at,
                               const ReferenceView& view) const {
  glm::dvec3 shade{light_->ambient};
  for (const ReferenceLight& light : view.lights)
    shade += light_->diffuse * std::max(0.0, glm::dot(at.normal, light.toLight)) * light.radiance;
  const glm::dvec3 shaded = colour * blend(glm::dvec3{1}, shade, at.confidence);
  return blend(shaded, at.normal / 2.0 + 0.5, light_->normalColour * at.confidence);
}

/// The tone whose step lies nearest below, going over into the next one around the step.
glm::dvec3 ReferenceLayer::tooned(const glm::dvec3& colour, const ReferenceFacing& at,
                                  const ReferenceView& view) const {
  double intensity = 0;
  for (const ReferenceLight& light : view.lights)
    intensity += std::max(0.0, glm::dot(at.normal, light.toLight)) *
                 glm::dot(light.radiance, glm::dvec3{0.2126, 0.7152, 0.0722});
  const double scaled = toon_->tones * std::min(intensity, 1.0);
  double tone = 0;
  for (int step = 1; step <= std::ceil(toon_->tones); ++step)
    tone += std::clamp((scaled - step) / toon_->softness + 0.5, 0.0, 1.0);
  const double whiteness = std::min(tone / (toon_->tones - 1), 1.0);
  return blend(colour, glm::dvec3{1}, toon_->strength * at.confidence * whiteness);
}

glm::dvec3 ReferenceLayer::distant(const glm::dvec3& colour, const glm::dvec3& world,
                                   const ReferenceView& view) const {
  const double position = depth_->direction.position(world, view);
  if (depth_->byDistance)
    return blend(colour, depth_->colour, depth_->strength * std::pow(position, depth_->exponent));
  return blend(colour * depth_->factor.at(position), depth_->colour, depth_->blend.at(position));
}

glm::dvec3 ReferenceLayer::creased(const glm::dvec3& colour, double laplacian) const {
  const auto beyond = [&](double threshold, double value) {
    return smoothstep(threshold, threshold + laplacian_->softness, value);
  };
  const double amount =
      std::max(beyond(laplacian_->above, laplacian), beyond(laplacian_->below, -laplacian));
  return blend(colour, laplacian_->colour, laplacian_->strength * amount);
}

/// Lines replace the colour by their share of the sample and bring extinction of their own, so that
/// they stand where `surface` has made the material itself transparent (techniques §1, pass II).
void ReferenceLayer::drawLines(Classified& sample, double lineExtinction, double factor,
                               const ReferenceFacing& at, const ReferenceView& view) const {
  double weight = 0;
  glm::dvec3 weighted{0};
  if (edges_) {
    const double measure = std::pow(edgeMeasure(at, view), edges_->power);
    const double w = edges_->strength * smoothstep(edges_->threshold, 1, measure);
    weight += w;
    weighted += w * edges_->colour;
  }
  if (specular_)
    for (const ReferenceLight& light : view.lights) {
      const double cosine = glm::dot(at.normal, unitOrZero(light.toLight + view.toEye));
      const double w = specular_->strength * std::pow(std::max(0.0, cosine), specular_->exponent) *
                       at.confidence;
      weight += w;
      weighted += w * light.radiance;
    }
  if (weight <= 0) return;
  const double share = factor * std::min(weight, 1.0);
  sample.colour = blend(sample.colour, weighted / weight, share);
  sample.extinction = std::max(sample.extinction, lineExtinction * share);
}

}  // namespace burin::node
