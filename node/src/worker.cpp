#include "burin/node/worker.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "brick.hpp"
#include "burin/common/error.hpp"
#include "burin/node/offscreen_context.hpp"
#include "burin/node/thread_share.hpp"
#include "clip_planes.hpp"
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

/// Cost of the owner that has most, over the mean of all.
double unevenness(const BrickTree& tree, const CostEstimate& cost) {
  double sum = 0;
  double largest = 0;
  for (int owner = 0; owner < tree.ownerCount(); ++owner) {
    double share = 0;
    for (const BrickId brick : tree.bricksOf(owner)) share += cost(tree.brickCells(brick));
    sum += share;
    largest = std::max(largest, share);
  }
  return sum > 0 ? largest * tree.ownerCount() / sum : 1;
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
  const Communicator& comm;
  BrickSource& source;
  Scene scene;
  WorkerOptions options;
  Rank firstOwner{0};  ///< rank of owner 0
  VolumeSurvey survey;
  bool hasGradients = false;  ///< the survey's
  BrickTree tree;
  int ghosts = 0;                           ///< of the bricks loaded
  std::optional<OffscreenContext> context;  ///< before everything that holds GL names
  std::optional<Raycaster> raycaster;
  std::vector<Brick> bricks;

  State(const Communicator& givenComm, BrickSource& givenSource, const Scene& givenScene,
        const WorkerOptions& givenOptions)
      : comm{givenComm},
        source{givenSource},
        scene{givenScene},
        options{givenOptions},
        firstOwner{givenOptions.dedicatedHost ? 1 : 0} {}

  /// The brick of this rank with that id, or nullptr.
  const Brick* find(BrickId id) const {
    const auto found = std::ranges::find(bricks, id, &Brick::id);
    return found == bricks.end() ? nullptr : &*found;
  }

  bool isSplitBadly(const Scene& next) const;
  void load();
  void classify();
};

/// Whether loading bricks anew is worth it: the split leaves one owner twice the mean cost of that
/// scene, and a new one would take a quarter off that. The same answer on every rank.
bool Worker::State::isSplitBadly(const Scene& next) const {
  const VolumeInfo& volume = source.info();
  const CostEstimate cost{survey.blocks, volume.grid, next};
  const double now = unevenness(tree, cost);
  return now > 2 && unevenness(partition(comm, next, volume, survey, options), cost) < 0.75 * now;
}

/// Collective. Splits the volume for the scene and loads this rank's bricks.
void Worker::State::load() {
  const VolumeInfo& volume = source.info();
  if (const bool needed = gradientNeeded(scene);
      survey.blocks.lowest.empty() || needed > hasGradients) {
    survey = surveyVolume(comm, source, needed);
    hasGradients = needed;
  }
  tree = partition(comm, scene, volume, survey, options);
  ghosts = ghostLayers(scene, options);
  const int owner = static_cast<int>(comm.rank()) - static_cast<int>(firstOwner);
  const std::vector<BrickId> mine =
      owner >= 0 && owner < tree.ownerCount() ? tree.bricksOf(owner) : std::vector<BrickId>{};
  const int threads = threadShare(comm, !mine.empty());
  const ValueScale scale = valueScaleOf(volume.type, survey);
  std::vector<IndexBox> boxes;
  collectively(comm, "preparing to draw", [&] {
    bricks.clear();
    raycaster.reset();
    if (mine.empty()) return;  // an idle rank needs no OpenGL
    if (!context) context.emplace(ContextOptions{threads});
    context->makeCurrent();
    raycaster.emplace(scene, volume.grid, scale,
                      Raycaster::GradientScales{survey.gradient999, survey.largestGradient},
                      RaycastOptions{options.skip, options.countSamples, mine.size() > 1});
    for (const BrickId id : mine) {
      bricks.emplace_back(id, tree.brickCells(id), ghosts, volume, scale);
      boxes.push_back(bricks.back().storedVoxels());
    }
  });
  loadBricks(comm, source, boxes, bricks);
  collectively(comm, "classifying bricks", [&] {
    for (Brick& brick : bricks) brick.finishLoading();
    classify();
  });
}

/// Local. What the scene can show of each brick.
void Worker::State::classify() {
  if (bricks.empty()) return;
  const VisibleValues visible{scene, raycaster->transferTables(),
                              valueScaleOf(source.info().type, survey)};
  const std::vector<glm::vec4> planes = centredClipPlanes(scene, source.info().grid);
  for (Brick& brick : bricks) brick.classify(visible, planes);
}

Worker::Worker(const Communicator& comm, const Scene& scene, BrickSource& source,
               const WorkerOptions& options)
    : state_{std::make_unique<State>(comm, source, scene, options)} {
  state_->load();
}

void Worker::update(const Scene& scene) {
  State& state = *state_;
  const bool mustLoad = ghostLayers(scene, state.options) > state.ghosts ||
                        (gradientNeeded(scene) && !state.hasGradients) || state.isSplitBadly(scene);
  const bool sameShown = state.scene.clip == scene.clip &&
                         std::ranges::equal(state.scene.layers, scene.layers, {},
                                            &Layer::transferFunction, &Layer::transferFunction);
  const Scene before = std::exchange(state.scene, scene);
  if (mustLoad) return state.load();
  const auto apply = [&] {
    if (!state.raycaster) return;
    state.context->makeCurrent();
    state.raycaster->setScene(state.scene);
    if (!sameShown) state.classify();
  };
  try {
    agree(state.comm, "changing the scene", attempt(apply));
  } catch (const CollectiveError&) {
    // Also where it went well: all ranks must draw the same scene.
    state.scene = before;
    apply();
    throw;
  }
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
                                            const PixelRoom& room, const StepMap* steps) {
  std::vector<const Brick*> bricks;
  if (!state_->bricks.empty()) {
    for (const BrickId id : state_->tree.visibilityOrder(camera))
      if (const Brick* brick = state_->find(id)) bricks.push_back(brick);
  }
  return drawThese(bricks, camera, statistics, room, steps);
}

compositor::SubimageView<Rgba> Worker::drawBrick(BrickId brick, const Camera& camera,
                                                 RankStatistics& statistics,
                                                 const PixelRoom& room) {
  const Brick* const found = state_->find(brick);
  BURIN_CHECK(found != nullptr);
  return drawThese(std::span{&found, 1}, camera, statistics, room, nullptr);
}

/// `bricks`: front to back.
compositor::SubimageView<Rgba> Worker::drawThese(std::span<const Brick* const> bricks,
                                                 const Camera& camera, RankStatistics& statistics,
                                                 const PixelRoom& room, const StepMap* steps) {
  statistics.bricks = static_cast<std::int32_t>(bricks.size());
  for (const Brick* brick : bricks)
    statistics.residentVoxelBytes += static_cast<std::int64_t>(brick->residentBytes());
  if (!state_->raycaster) return {camera.image, {}, {}};
  state_->context->makeCurrent();
  return state_->raycaster->draw(camera, bricks, statistics, room, steps);
}

}  // namespace burin::node
