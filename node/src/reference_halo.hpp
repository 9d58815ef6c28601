#pragma once

#include <optional>

#include "burin/common/scene.hpp"
#include "reference_view.hpp"
#include "reference_volume.hpp"

namespace burin::node {

/// Rims around features: neighbours of a place, if they lie on an outline of something that a layer
/// shows, make it dark. After Ebert and Rheingans' feature halos, with six neighbours in the
/// picture's plane instead of all around, gradients as wide as half the neighbours' distance, and
/// the opacity on their inner side as a factor.
class ReferenceHalo {
 public:
  /// `gradientScale`, `noiseFloor`: the layer's.
  ReferenceHalo(const Layer& layer, double gradientScale, double noiseFloor);

  /// What neighbours cast on a place in world space, 0 … 1, as if it had no gradient itself.
  double castOn(const glm::dvec3& world, const ReferenceVolume& volume,
                const ReferenceView& view) const;

  /// The halo's extinction added to a sample of gradient magnitude m.
  Classified over(const Classified& sample, double cast, double m) const;

 private:
  double castBy(const glm::dvec3& neighbour, const glm::dvec3& towards,
                const ReferenceVolume& volume, const ReferenceView& view) const;

  TransferFunction features_;
  double unitLength_, gradientScale_, noiseFloor_;
  HaloNeighbourhood around_;
  double strength_, directionPower_, edgePower_;
  bool isInward_ = false;
  glm::dvec3 colour_;
};

}  // namespace burin::node
