#pragma once

#include "burin/common/brick_tree.hpp"
#include "burin/common/communicator.hpp"
#include "burin/node/survey.hpp"
#include "burin/node/worker.hpp"
#include "drawing_cost.hpp"
#include "value_scale.hpp"

namespace burin::node {

// What is measured and loaded for a scene, for the foreseen ones at the same time.

int ghostLayers(const Scene& scene, const WorkerOptions& options);
bool loadsLaplacian(const Scene& scene, const WorkerOptions& options);
SurveyRequest surveyFor(const Scene& scene, const WorkerOptions& options);

/// How far from a macrocell in which a value shows a layer may be bound to labels: as far as a
/// segment's middle is from its end, to the voxels around the middle, and as far as a look-up may
/// round.
int labelReach(const Scene& scene);

/// The split of the volume among the ranks of `comm` that draw. `withLaplacian`: bricks have a
/// texture of it too.
BrickTree partition(const Communicator& comm, const DrawingCost& cost, int ghosts,
                    const VolumeInfo& volume, const ValueScale& scale, bool withLaplacian,
                    const WorkerOptions& options);

}  // namespace burin::node
