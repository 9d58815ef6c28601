#include "reference_layer.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

template <typename T>
T blend(const T& a, const T& b, double amount) {
  return a + (b - a) * amount;
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3{0};
}

}  // namespace

ReferenceLayer::ReferenceLayer(const Layer& layer, ReferenceGradientScale& scale)
    : transferFunction_{layer.transferFunction},
      unitLength_{transferFunction_.opacityUnitLength.value()},
      means_{transferFunction_, unitLength_} {
  if (const auto* s = layer.style("surface")) surface_ = Surface{s->curve("opacity")};
  if (const auto* s = layer.style("light"))
    light_ = Lit{s->number("ambient"), s->number("diffuse"), s->number("normal_color")};
  if (const auto* s = layer.style("tone"))
    tone_ =
        Tone{s->word("mode") == "gooch", s->number("strength"),      s->number("transition"),
             s->number("yellow"),        s->number("blue"),          s->number("alpha"),
             s->number("beta"),          s->colour("warm").linear(), s->colour("cool").linear()};
  if (const auto* s = layer.style("edges"))
    edges_ = Edges{s->number("strength"), s->number("threshold"), s->number("power"),
                   s->colour("color").linear()};
  if (const auto* s = layer.style("specular"))
    specular_ = Specular{s->number("strength"), s->number("exponent")};
  if (needsGradient()) readGradientSettings(layer, scale);
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
  gradientScale_ = settings.word("magnitude") == "maximum" ? scale.maximum() : scale.percentile();
}

Classified ReferenceLayer::classify(double value) const {
  return transferFunction_.classify(value, unitLength_);
}

Classified ReferenceLayer::classify(double front, double back) const {
  return means_.between(front, back);
}

Classified ReferenceLayer::shade(const Classified& plain, const glm::dvec3& gradient,
                                 const ReferenceView& view) const {
  if (!needsGradient()) return plain;
  const Facing at = facing(gradient, view);
  Classified sample = plain;
  if (surface_) sample.extinction *= surface_->opacity.at(at.magnitude);
  if (light_) sample.colour = lit(sample.colour, at, view);
  if (tone_) sample.colour = toned(sample.colour, at, view);
  if (edges_ || specular_) drawLines(sample, plain.extinction, at, view);
  return sample;
}

ReferenceLayer::Facing ReferenceLayer::facing(const glm::dvec3& gradient,
                                              const ReferenceView& view) const {
  Facing at;
  if (gradientScale_ > 0) at.magnitude = std::min(glm::length(gradient) / gradientScale_, 1.0);
  at.confidence = smoothstep(noiseFloor_, 2 * noiseFloor_, at.magnitude);
  at.normal = unitOrZero(gradient);
  const bool flip = orientation_ == Orientation::kOutward ||
                    (orientation_ == Orientation::kFacing && glm::dot(at.normal, view.toEye) < 0);
  if (flip) at.normal = -at.normal;
  return at;
}

glm::dvec3 ReferenceLayer::lit(const glm::dvec3& colour, const Facing& at,
                               const ReferenceView& view) const {
  glm::dvec3 shade{light_->ambient};
  for (const ReferenceLight& light : view.lights)
    shade += light_->diffuse * std::max(0.0, glm::dot(at.normal, light.toLight)) * light.radiance;
  const glm::dvec3 shaded = colour * blend(glm::dvec3{1}, shade, at.confidence);
  return blend(shaded, at.normal / 2.0 + 0.5, light_->normalColour * at.confidence);
}

glm::dvec3 ReferenceLayer::toned(const glm::dvec3& colour, const Facing& at,
                                 const ReferenceView& view) const {
  if (view.lights.empty()) return colour;
  const double towards = glm::dot(at.normal, view.lights.front().toLight);
  const double amount = tone_->strength * at.confidence;
  if (!tone_->gooch) {
    const double warmth = smoothstep(-tone_->transition, tone_->transition, towards);
    return colour * blend(glm::dvec3{1}, blend(tone_->cool, tone_->warm, warmth), amount);
  }
  const glm::dvec3 warm = glm::dvec3{tone_->yellow, tone_->yellow, 0} + tone_->beta * colour;
  const glm::dvec3 cool = glm::dvec3{0, 0, tone_->blue} + tone_->alpha * colour;
  return blend(colour, warm * ((1 + towards) / 2) + cool * ((1 - towards) / 2), amount);
}

/// Lines replace the colour by their share of the sample and bring extinction of their own, so that
/// they stand where `surface` has made the material itself transparent (techniques §1, pass II).
void ReferenceLayer::drawLines(Classified& sample, double plainExtinction, const Facing& at,
                               const ReferenceView& view) const {
  double weight = 0;
  glm::dvec3 weighted{0};
  if (edges_) {
    const double sideways = std::max(0.0, 1 - std::abs(glm::dot(at.normal, view.toEye)));
    const double measure = std::pow(sideways * at.confidence, edges_->power);
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
  const double share = std::min(weight, 1.0);
  sample.colour = blend(sample.colour, weighted / weight, share);
  sample.extinction = std::max(sample.extinction, plainExtinction * share);
}

}  // namespace burin::node
