#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "burin/common/scene.hpp"
#include "reference_gradient_scale.hpp"
#include "reference_mean_class.hpp"

namespace burin::node {

/// A light as the styles meet it.
struct ReferenceLight {
  glm::dvec3 toLight{0, 0, 1};  ///< unit, world space
  glm::dvec3 radiance{1};       ///< linear colour times intensity
};

/// Where a sample is seen from and lit from.
struct ReferenceView {
  glm::dvec3 toEye{0, 0, 1};  ///< unit, world space
  std::span<const ReferenceLight> lights;
};

/// One layer of the scene, its settings looked up once, evaluated sample by sample.
class ReferenceLayer {
 public:
  ReferenceLayer(const Layer& layer, ReferenceGradientScale& scale);

  bool needsGradient() const { return surface_ || light_ || tone_ || edges_ || specular_; }

  /// The transfer function alone: of one value, or the mean over the values between two.
  Classified classify(double value) const;
  Classified classify(double front, double back) const;

  /// What the styles make of it; `gradient` in world units, ignored if none needs it.
  Classified shade(const Classified& plain, const glm::dvec3& gradient,
                   const ReferenceView& view) const;

 private:
  struct Surface {
    Curve opacity;
  };
  struct Lit {
    double ambient, diffuse, normalColour;
  };
  struct Tone {
    bool gooch;
    double strength, transition, yellow, blue, alpha, beta;
    glm::dvec3 warm, cool;
  };
  struct Edges {
    double strength, threshold, power;
    glm::dvec3 colour;
  };
  struct Specular {
    double strength, exponent;
  };
  /// The direction-dependent facts of one sample.
  struct Facing {
    glm::dvec3 normal{0};   ///< unit, or zero where the gradient is
    double magnitude = 0;   ///< m, in [0, 1]
    double confidence = 0;  ///< q(m)
  };

  void readGradientSettings(const Layer& layer, ReferenceGradientScale& scale);
  Facing facing(const glm::dvec3& gradient, const ReferenceView& view) const;
  glm::dvec3 lit(const glm::dvec3& colour, const Facing& at, const ReferenceView& view) const;
  glm::dvec3 toned(const glm::dvec3& colour, const Facing& at, const ReferenceView& view) const;
  void drawLines(Classified& sample, double plainExtinction, const Facing& at,
                 const ReferenceView& view) const;

  enum class Orientation { kOutward, kInward, kFacing };

  TransferFunction transferFunction_;
  double unitLength_;
  ReferenceMeanClass means_;
  double noiseFloor_ = 0;
  double gradientScale_ = 0;
  Orientation orientation_ = Orientation::kOutward;
  std::optional<Surface> surface_;
  std::optional<Lit> light_;
  std::optional<Tone> tone_;
  std::optional<Edges> edges_;
  std::optional<Specular> specular_;
};

}  // namespace burin::node
