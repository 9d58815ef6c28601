#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "burin/common/scene.hpp"
#include "reference_cut.hpp"
#include "reference_gradient_scale.hpp"
#include "reference_halo.hpp"
#include "reference_mean_class.hpp"
#include "reference_tone.hpp"
#include "reference_view.hpp"
#include "reference_widgets.hpp"

namespace burin::node {

/// What the values of a segment say before any style.
struct ReferenceClass {
  Classified plain;           ///< pass I
  double lineExtinction = 0;  ///< pass II, where lines are opaque

  bool shows() const { return plain.extinction > 0 || lineExtinction > 0; }
  /// As far as the place belongs to the layer.
  void scale(double membership) {
    plain.extinction *= membership;
    lineExtinction *= membership;
  }
};

/// What styles know of a sample's surroundings.
struct ReferencePlace {
  glm::dvec3 world{0};     ///< where it is
  glm::dvec3 gradient{0};  ///< world units, by the layer's operator
  ReferenceCut cut;
  double laplacian = 0;  ///< in [-1, 1]
  double halo = 0;       ///< of the layer: ReferenceHalo::castOn()
};

/// One layer of the scene, its settings looked up once, evaluated sample by sample.
class ReferenceLayer {
 public:
  ReferenceLayer(const Layer& layer, ReferenceGradientScale& scale);

  bool needsGradient() const;

  GradientOperator gradientOperatorUsed() const { return operator_; }

  /// Value of the surface that the layer is, if it is one.
  const std::optional<double>& isoValue() const { return isoValue_; }
  /// Those it is bound to, if any.
  const std::vector<LabelName>& labels() const { return labels_; }
  /// Of such a surface: opacities stand where media have extinctions.
  ReferenceClass isoClass() const;

  /// The transfer function alone: of one value, or the mean over the values between two.
  ReferenceClass classify(double value) const;
  ReferenceClass classify(double front, double back) const;
  /// Whether classes depend on the gradient too; then only this one says them.
  bool isTwoDimensional() const { return widgets_.has_value(); }
  ReferenceClass classify(double front, double back, const glm::dvec3& gradient) const;

  /// nullptr if the layer has none.
  const ReferenceHalo* halo() const { return halo_ ? &*halo_ : nullptr; }

  /// What the styles make of it.
  Classified shade(const ReferenceClass& classes, const ReferencePlace& place,
                   const ReferenceView& view) const;

 private:
  /// A factor constant + scale * x^exponent on extinction.
  struct Enhancement {
    double constant, scale, exponent;
    double at(double x) const;
  };
  struct Lit {
    double ambient, diffuse, normalColour;
  };
  struct Toon {
    double tones, strength, softness;
  };
  struct Direction {
    bool byView;
    glm::dvec3 axis;
    double position(const glm::dvec3& world, const ReferenceView& view) const;
  };
  struct Fade {
    Direction direction;
    Curve opacity;
  };
  struct Depth {
    Direction direction;
    bool byDistance;
    ColourCurve factor;
    Curve blend;
    glm::dvec3 colour;
    double strength, exponent;
  };
  struct Laplacian {
    double above, below, softness, strength;
    glm::dvec3 colour;
  };
  struct Edges {
    double strength, threshold, power;
    glm::dvec3 colour;
  };
  struct Specular {
    double strength, exponent;
  };

  static Direction directionOf(const StyleSettings& settings);
  static Enhancement enhancementOf(const StyleSettings& settings);
  void readExtinctionStyles(const Layer& layer);
  void readColourStyles(const Layer& layer);
  void readLineStyles(const Layer& layer);
  void readGradientSettings(const Layer& layer, ReferenceGradientScale& scale);

  /// m of a gradient in world units.
  double magnitudeOf(const glm::dvec3& gradient) const;
  ReferenceFacing facing(const glm::dvec3& gradient, const ReferenceView& view) const;
  /// The unit normal of a surface, `inward`: unit, into its material, or zero.
  glm::dvec3 orientedNormal(const glm::dvec3& inward, const ReferenceView& view) const;
  /// A surface where it is cut: for light, tone and toon.
  ReferenceFacing cutThrough(const ReferenceFacing& at, const ReferenceCut& cut,
                             const ReferenceView& view) const;
  glm::dvec3 creased(const glm::dvec3& colour, double laplacian) const;
  glm::dvec3 lit(const glm::dvec3& colour, const ReferenceFacing& at,
                 const ReferenceView& view) const;
  glm::dvec3 tooned(const glm::dvec3& colour, const ReferenceFacing& at,
                    const ReferenceView& view) const;
  glm::dvec3 distant(const glm::dvec3& colour, const glm::dvec3& world,
                     const ReferenceView& view) const;
  void drawLines(Classified& sample, double lineExtinction, double factor,
                 const ReferenceFacing& at, const ReferenceView& view) const;

  enum class Orientation { kOutward, kInward, kFacing };

  TransferFunction transferFunction_;
  double unitLength_;
  ReferenceMeanClass means_;
  std::optional<ReferenceWidgets> widgets_;
  std::optional<TransferFunction> lineFunction_;  ///< pass II's own
  std::optional<ReferenceMeanClass> lineMeans_;
  std::optional<double> isoValue_;
  std::vector<LabelName> labels_;
  double isoOpacity_;
  GradientOperator operator_ = GradientOperator::kCentral;
  double noiseFloor_ = 0;
  double gradientScale_ = 0;
  Orientation orientation_ = Orientation::kOutward;
  std::optional<Curve> surface_, lineSurface_;
  std::optional<Enhancement> boundary_, silhouette_;
  std::optional<Fade> fade_;
  std::optional<Lit> light_;
  std::optional<ReferenceTone> tone_;
  std::optional<Toon> toon_;
  std::optional<Depth> depth_;
  std::optional<Laplacian> laplacian_;
  std::optional<ReferenceHalo> halo_;
  std::optional<Edges> edges_;
  std::optional<Specular> specular_;
};

}  // namespace burin::node
