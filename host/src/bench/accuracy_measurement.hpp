#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/compositing_input.hpp"
#include "bench/picture_error.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/node/technique.hpp"

namespace burin::host::bench {

/// One way of drawing a scene, what it costs and how far it is off.
struct AccuracyMeasurement {
  std::string scene;
  node::Technique technique = node::Technique::kRaycast;
  node::Precision precision = node::Precision::kFloat;
  Combine combine = Combine::kSum;
  Normals normals = Normals::kExact;
  Palettes palettes = Palettes::kAfter;
  bool preintegrated = true;
  std::optional<double> stepVoxels;  ///< unset: chosen for maxErrorAsked
  std::optional<double> maxErrorAsked;
  double medianMs = 0;  ///< of whole frames, choosing the step included
  std::int64_t samplesVisited = 0;
  PictureError error;
  double referenceChange = 0;  ///< largest change of the truth when it is asked for twice as much
};

struct AccuracyPlan {
  std::vector<double> steps{4, 2, 1, 0.5, 0.25, 0.125};
  std::vector<double> maxErrors{1.0 / 32, 1.0 / 128, 1.0 / 512};
  std::vector<double> sliceSteps{2, 1, 0.5, 0.25};  ///< of slices, in every precision
  std::vector<double> historicSteps{1, 0.5};        ///< of slices as hardware drew them
  double referenceError = 2e-5;                     ///< that the truth is asked for
  int repeats = 5;
};

/// Collective. Draws the scene in all ways of the plan, in turns, `repeats` times, and compares
/// with the double-precision reference. The same rows on rank 0, without errors elsewhere.
std::vector<AccuracyMeasurement> measureAccuracy(const Communicator& comm, NamedScene& scene,
                                                 const AccuracyPlan& plan);

}  // namespace burin::host::bench
