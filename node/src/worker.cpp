#include "burin/node/worker.hpp"

#include <algorithm>
#include <optional>

#include "brick.hpp"
#include "burin/node/offscreen_context.hpp"
#include "burin/node/thread_share.hpp"
#include "cost_estimate.hpp"
#include "raycaster.hpp"

namespace burin::node {
namespace {

int ghostLayers(const Scene& scene, const WorkerOptions& options) {
  return options.ghostLayers.value_or(ghostLayersNeeded(scene));
}

BrickTree partition(const Communicator& comm, const Scene& scene, const VolumeInfo& volume,
                    const VolumeSurvey& survey, const WorkerOptions& options) {
  const ValueScale scale = valueScaleOf(volume.type, survey);
  const int ghosts = ghostLayers(scene, options);
  BrickTree::Request request;
  request.grid = volume.grid;
  request.owners = comm.size() - (options.dedicatedHost ? 1 : 0);
  request.bricks = options.bricks;
  request.cost = CostEstimate{survey.blocks, volume.grid, scene};
  request.tooLarge = [&](const IndexBox& cells) {
    const IndexBox stored = storedVoxels(cells, ghosts, volume.grid);
    const glm::ivec3 size = stored.size();
    return std::max({size.x, size.y, size.z}) > kLargestTextureExtent ||
           stored.count() * bytesPerTexel(volume.type, scale.hasInvalid) > kLargestTextureBytes;
  };
  return BrickTree::build(request);
}

/// Collective. Voxels straight into textures; what is staged is a few times kSlabBytes.
void loadBricks(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
                std::span<Brick> bricks) {
  constexpr std::size_t kSlabBytes = std::size_t{8} << 20;
  StagingBuffer staging;
  readSlabs(
      comm, source, boxes,
      [&](const Slab& slab) { bricks[slab.request].upload(slab.box, slab.voxels, staging); },
      kSlabBytes);
}

}  // namespace

struct Worker::State {
  Scene scene;
  WorkerOptions options;
  Rank firstOwner{0};  ///< rank of owner 0
  VolumeSurvey survey;
  BrickTree tree;
  std::optional<OffscreenContext> context;  ///< before everything that holds GL names
  std::optional<Raycaster> raycaster;
  std::vector<Brick> bricks;

  /// The brick of this rank with that id, or nullptr.
  const Brick* find(BrickId id) const {
    const auto found = std::ranges::find(bricks, id, &Brick::id);
    return found == bricks.end() ? nullptr : &*found;
  }
};

Worker::Worker(const Communicator& comm, const Scene& scene, BrickSource& source,
               const WorkerOptions& options)
    : state_{std::make_unique<State>()} {
  State& state = *state_;
  const VolumeInfo& volume = source.info();
  state.scene = scene;
  state.options = options;
  state.firstOwner = Rank{options.dedicatedHost ? 1 : 0};
  state.survey = surveyVolume(comm, source, gradientNeeded(scene));
  state.tree = partition(comm, scene, volume, state.survey, options);
  const int owner = static_cast<int>(comm.rank()) - static_cast<int>(state.firstOwner);
  const std::vector<BrickId> mine = owner >= 0 && owner < state.tree.ownerCount()
                                        ? state.tree.bricksOf(owner)
                                        : std::vector<BrickId>{};
  const int threads = threadShare(comm, !mine.empty());
  const ValueScale scale = valueScaleOf(volume.type, state.survey);

  const int ghosts = ghostLayers(scene, options);

  std::vector<IndexBox> boxes;
  collectively(comm, "preparing to draw", [&] {
    if (mine.empty()) return;  // an idle rank needs no OpenGL
    state.context.emplace(ContextOptions{threads});
    state.raycaster.emplace(
        scene, volume.grid, scale,
        Raycaster::GradientScales{state.survey.gradient999, state.survey.largestGradient},
        RaycastOptions{options.skip, options.countSamples});
    for (const BrickId id : mine) {
      state.bricks.emplace_back(id, state.tree.brickCells(id), ghosts, volume, scale);
      boxes.push_back(state.bricks.back().storedVoxels());
    }
  });
  loadBricks(comm, source, boxes, state.bricks);
  collectively(comm, "classifying bricks", [&] {
    for (Brick& brick : state.bricks) {
      brick.finishLoading();
      brick.classify(scene, state.raycaster->transferTables(), scale);
    }
  });
}

Worker::~Worker() {
  if (state_->context) state_->context->makeCurrent();
}

const VolumeSurvey& Worker::survey() const {
  return state_->survey;
}

const BrickTree& Worker::tree() const {
  return state_->tree;
}

std::vector<Rank> Worker::visibilityOrder(const Camera& camera) const {
  std::vector<Rank> ranks;
  for (const int owner : state_->tree.ownerVisibilityOrder(camera))
    ranks.push_back(Rank{owner + static_cast<int>(state_->firstOwner)});
  return ranks;
}

compositor::Subimage<Rgba> Worker::draw(const Camera& camera, RankStatistics& statistics) {
  compositor::Subimage<Rgba> image{camera.image, {}, {}};
  image.active = draw(camera, statistics, [&](std::size_t pixels) {
                   image.pixels.resize(pixels);
                   return std::span{image.pixels};
                 }).active;
  return image;
}

compositor::SubimageView<Rgba> Worker::draw(const Camera& camera, RankStatistics& statistics,
                                            const PixelRoom& room) {
  const State& state = *state_;
  statistics.bricks = static_cast<std::int32_t>(state.bricks.size());
  for (const Brick& brick : state.bricks)
    statistics.residentVoxelBytes += static_cast<std::int64_t>(brick.residentBytes());
  if (!state_->raycaster) return {camera.image, {}, {}};
  state_->context->makeCurrent();
  std::vector<const Brick*> bricks;
  for (const BrickId id : state.tree.visibilityOrder(camera))
    if (const Brick* brick = state.find(id)) bricks.push_back(brick);
  return state_->raycaster->draw(camera, bricks, statistics, room);
}

}  // namespace burin::node
