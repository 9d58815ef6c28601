#include "worker_needs.hpp"

#include <algorithm>
#include <utility>

#include "balanced_tree.hpp"
#include "brick.hpp"

namespace burin::node {

int ghostLayers(const Scene& scene, const WorkerOptions& options) {
  int most = ghostLayersNeeded(scene);
  for (const Scene& other : options.foreseen) most = std::max(most, ghostLayersNeeded(other));
  return options.ghostLayers.value_or(most);
}

bool loadsLaplacian(const Scene& scene, const WorkerOptions& options) {
  return laplacianNeeded(scene) || std::ranges::any_of(options.foreseen, laplacianNeeded);
}

SurveyRequest surveyFor(const Scene& scene, const WorkerOptions& options) {
  SurveyRequest request{gradientOperatorsNeeded(scene), loadsLaplacian(scene, options)};
  for (const Scene& other : options.foreseen)
    request.gradients = request.gradients | gradientOperatorsNeeded(other);
  return request;
}

int labelReach(const Scene& scene) {
  constexpr double kRounding = 0.01;
  constexpr double kMost = kLargestTextureExtent;
  return static_cast<int>(std::min(segmentReachVoxels(scene) + kRounding, kMost)) + 1;
}

BrickTree partition(const Communicator& comm, const DrawingCost& cost, int ghosts,
                    const VolumeInfo& volume, const ValueScale& scale, bool withLaplacian,
                    const WorkerOptions& options) {
  const std::size_t texelBytes = std::max(bytesPerTexel(volume.type, scale.hasInvalid),
                                          withLaplacian ? sizeof(float) : std::size_t{0});
  BrickTree::Request request;
  request.grid = volume.grid;
  request.owners = comm.size() - (options.dedicatedHost ? 1 : 0);
  request.bricks = options.bricks;
  request.tooLarge = [&](const IndexBox& cells) {
    const IndexBox stored = storedVoxels(cells, ghosts, volume.grid);
    const glm::ivec3 size = stored.size();
    return std::max({size.x, size.y, size.z}) > kLargestTextureExtent ||
           stored.count() * texelBytes > kLargestTextureBytes;
  };
  return balancedTree(std::move(request), cost);
}

}  // namespace burin::node
