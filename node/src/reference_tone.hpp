#pragma once

#include <glm/glm.hpp>

#include "burin/common/style.hpp"
#include "reference_view.hpp"

namespace burin::node {

/// The style "tone" in all its modes.
class ReferenceTone {
 public:
  explicit ReferenceTone(const StyleSettings& settings);

  /// `colour` toned, as far as the sample has a direction.
  glm::dvec3 apply(const glm::dvec3& colour, const ReferenceFacing& at,
                   const ReferenceView& view) const;

 private:
  glm::dvec3 gooch(const glm::dvec3& colour, double cosine) const;
  glm::dvec3 ebert(const glm::dvec3& colour, const ReferenceFacing& at,
                   const ReferenceView& view) const;

  enum class Mode { kMap, kColours, kGooch, kEbert };

  Mode mode_;
  double strength_, transition_, yellow_, blue_, alpha_, beta_, ambient_, diffuse_;
  glm::dvec3 warm_, cool_;
  ColourCurve colours_;
};

}  // namespace burin::node
