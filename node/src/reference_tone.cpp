#include "reference_tone.hpp"

#include <algorithm>

#include "reference_blend.hpp"

namespace burin::node {

ReferenceTone::ReferenceTone(const StyleSettings& settings)
    : strength_{settings.number("strength")},
      transition_{settings.number("transition")},
      yellow_{settings.number("yellow")},
      blue_{settings.number("blue")},
      alpha_{settings.number("alpha")},
      beta_{settings.number("beta")},
      ambient_{settings.number("ambient")},
      diffuse_{settings.number("diffuse")},
      warm_{settings.colour("warm").linear()},
      cool_{settings.colour("cool").linear()},
      colours_{settings.colourCurve("colors")} {
  const std::string& mode = settings.word("mode");
  mode_ = mode == "colors"  ? Mode::kColours
          : mode == "gooch" ? Mode::kGooch
          : mode == "ebert" ? Mode::kEbert
                            : Mode::kMap;
}

glm::dvec3 ReferenceTone::apply(const glm::dvec3& colour, const ReferenceFacing& at,
                                const ReferenceView& view) const {
  if (view.lights.empty()) return colour;
  const double cosine = glm::dot(at.normal, view.lights.front().toLight);
  const double amount = strength_ * at.confidence;
  const auto factor = [&](const glm::dvec3& tone) {
    return colour * blend(glm::dvec3{1}, tone, amount);
  };
  switch (mode_) {
    case Mode::kMap:
      return factor(blend(cool_, warm_, smoothstep(-transition_, transition_, cosine)));
    case Mode::kColours:
      return factor(colours_.at(cosine));
    case Mode::kGooch:
      return blend(colour, gooch(colour, cosine), amount);
    case Mode::kEbert:
      return blend(colour, ebert(colour, at, view), amount);
  }
  return colour;
}

glm::dvec3 ReferenceTone::gooch(const glm::dvec3& colour, double cosine) const {
  const glm::dvec3 warm = glm::dvec3{yellow_, yellow_, 0} + beta_ * colour;
  const glm::dvec3 cool = glm::dvec3{0, 0, blue_} + alpha_ * colour;
  return warm * ((1 + cosine) / 2) + cool * ((1 - cosine) / 2);
}

glm::dvec3 ReferenceTone::ebert(const glm::dvec3& colour, const ReferenceFacing& at,
                                const ReferenceView& view) const {
  glm::dvec3 sum = ambient_ * colour;
  for (const ReferenceLight& light : view.lights) {
    const double cosine = glm::dot(at.normal, light.toLight);
    sum += gooch(colour, cosine) + diffuse_ * std::max(0.0, cosine) * light.radiance * colour;
  }
  return sum;
}

}  // namespace burin::node
