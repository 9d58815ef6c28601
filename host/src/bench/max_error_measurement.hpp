#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compositing_input.hpp"

namespace burin::host::bench {

/// A fixed step that is good enough, and what it costs.
struct FixedStep {
  double stepVoxels = 0;
  std::int64_t samples = 0;
};

/// How one picture kept the error that it was asked for.
struct MaxErrorMeasurement {
  std::string volume;
  std::string_view function;  ///< transfer function: "smooth" or "spiky"
  double azimuthDeg = 0, elevationDeg = 0;
  double asked = 0;                  ///< quality.max_error
  double errorMax = 0;               ///< largest difference to the truth, premultiplied linear RGBA
  std::int64_t samples = 0;          ///< in all, those that found the steps included
  std::optional<FixedStep> asGood;   ///< the largest fixed step with no larger an error
  std::optional<FixedStep> asAsked;  ///< the largest fixed step that keeps what was asked
  double truthChange = 0;  ///< largest change of the truth when it is asked for twice as much
};

struct View {
  double azimuthDeg, elevationDeg;
};

struct MaxErrorPlan {
  std::vector<double> asked{1.0 / 32, 1.0 / 128, 1.0 / 512};
  std::vector<View> views{{30, 20}, {150, -35}, {265, 70}};
  int side = 128;                  ///< of the square frames, pixels
  double smallestStep = 1.0 / 64;  ///< fixed steps are 4, 2, 1, … and this
  /// What the truth may be off by, in parts of the smallest error that is asked for.
  double truthPart = 0.1;
};

/// Collective. The plan's pictures of a volume, with a smooth and a spiky transfer function over
/// the values it has: each with the steps that the renderer chooses, then at fixed steps, until one
/// is as good. Pictures are compared with the double-precision reference, which knows no steps. The
/// scene's layers and quality are replaced. Rows on rank 0, without errors elsewhere.
std::vector<MaxErrorMeasurement> measureMaxError(const Communicator& comm, NamedScene& scene,
                                                 const MaxErrorPlan& plan);

/// The transfer functions over values from `lowest` to `highest`: "smooth" rises gently from
/// nothing; "spiky" has peaks of 1/250, 1/100 and 1/50 of the range, as thin shells are drawn with.
TransferFunction maxErrorFunction(std::string_view name, double lowest, double highest);

}  // namespace burin::host::bench
