#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::node {

/// 99.9th percentiles over the whole volume in which magnitudes are measured (world units): of
/// gradients, and of the smoothed Laplacian. Unset: the exact ones.
struct ReferenceScales {
  PerGradientOperator<std::optional<double>> gradients;
  std::optional<double> laplacian;
};
/// The survey's, as far as the scene needs them.
ReferenceScales surveyedScales(const VolumeSurvey& survey, const Scene& scene);

/// The slow, double-precision truth: written from techniques and scene contract alone, sharing no
/// formula with the shaders. Holds the whole volume. Local.
///
/// A ray is eye + depth * direction(pixel), the direction scaled to depth 1. Its segments are
/// [k, k+1] * step in depth, k any integer, clipped to the volume's box and the clip planes and
/// sampled at their middle (design, "The sample lattice is global and planar"); with
/// quality.preintegrated their classes are means over the values between their ends'. With
/// quality.max_error there is no step: a ray is cut where the volume bends or turns (cells' faces,
/// extremes within them) and the pieces are halved until that changes the pixel by no more.
class ReferenceRenderer {
 public:
  /// Loads all voxels. `scene` must be resolved (opacity unit lengths set).
  ///
  /// `scales`: the survey's are rounded up to a bin edge, up to 2^-10 above the exact ones: enough
  /// to move steep surface curves by more than renderer and reference may differ. A comparison of
  /// the two therefore hands the survey's numbers to both.
  ///
  /// `labels`: the label volume, needed if a layer is bound to labels.
  ///
  /// Throws Error{kVolume} if the voxels cannot be read.
  ReferenceRenderer(const Scene& scene, BrickSource& source, const ReferenceScales& scales = {},
                    BrickSource* labels = nullptr);
  ~ReferenceRenderer();
  ReferenceRenderer(const ReferenceRenderer&) = delete;
  ReferenceRenderer& operator=(const ReferenceRenderer&) = delete;

  /// Premultiplied linear RGBA of rows [firstRow, lastRow), full width, row-major. `threads` (>= 1)
  /// draw it; the result does not depend on their number, nor on how a frame is cut into rows. The
  /// scene's step and termination count; its camera and background do not.
  std::vector<glm::dvec4> render(const Camera& camera, int firstRow, int lastRow,
                                 int threads) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
