#include "brick_renderer.hpp"

#include "burin/common/footprint.hpp"

namespace burin::node {

std::vector<BrickJob> brickJobs(const Camera& camera, const VolumeGrid& grid,
                                std::span<const Brick* const> bricks, bool skip) {
  std::vector<BrickJob> jobs;
  for (const Brick* brick : bricks) {
    const IndexBox& cells = skip ? brick->visibleCells() : brick->cells();
    const PixelRect pixels = footprint(camera, grid, cells);
    if (!pixels.empty()) jobs.push_back({brick, pixels});
  }
  return jobs;
}

PixelRect activeArea(std::span<const BrickJob> jobs) {
  PixelRect area;
  for (const BrickJob& job : jobs) area = boundingRect(area, job.pixels);
  return area;
}

std::vector<StepRun> stepRuns(const BrickJob& job, double stepVoxels, const StepMap* steps) {
  if (steps != nullptr) return stepRuns(*steps, job.pixels);
  return {{stepVoxels, job.pixels}};
}

}  // namespace burin::node
