#pragma once

#include <vector>

#include "burin/common/geometry.hpp"
#include "burin/common/transfer_function.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// What is seen of two materials of which one surrounds the other.
struct Visibility {
  double skin = 1;  ///< mean opacity of the outer one where nothing else is on the ray
  double core = 1;  ///< of the inner one, of what would be seen of it without the other
};

/// Parallel rays through a survey's blocks: what a transfer function shows of a volume, before
/// anything is drawn. In each block every value between its lowest and its highest counts alike.
/// What opacities do to what is seen: Correa & Ma, "Visibility-driven transfer functions",
/// PacificVis 2009.
class CoarseLook {
 public:
  /// `function`: of points, opacityUnitLength set; values from `coreFrom` on are the inner
  /// material. `forwardWorld`: where the rays go, of length 1.
  CoarseLook(const VolumeGrid& grid, const node::BlockRanges& blocks,
             const TransferFunction& function, double coreFrom, const glm::dvec3& forwardWorld);

  /// With extinctions of the outer material times `factor`. Where there is nothing of a material,
  /// its share is 1.
  Visibility withSkin(double factor) const;

 private:
  struct Extinctions {  ///< per world unit
    double skin = 0;
    double core = 0;
  };
  /// One ray; light in [0, 1].
  struct Seen {
    double skin = 0;
    double core = 0;
    double coreAlone = 0;  ///< without a skin
    bool hasSkin = false;
  };
  Seen follow(const glm::dvec2& start, double factor) const;

  glm::ivec3 blocks_;
  std::vector<Extinctions> extinctions_;
  /// Rays pass one block of each layer along this axis, from one of its ends to the other.
  int axis_ = 2;
  bool isDescending_ = false;
  glm::dvec2 slope_{0};     ///< blocks of the two other axes per layer
  double layerLength_ = 1;  ///< of a ray in a layer, world units
};

}  // namespace burin::host
