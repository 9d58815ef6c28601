#include "burin/node/worker.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "balanced_tree.hpp"
#include "brick.hpp"
#include "brick_loading.hpp"
#include "burin/common/error.hpp"
#include "burin/common/trace.hpp"
#include "burin/node/thread_share.hpp"
#include "clip_planes.hpp"
#include "drawing_cost.hpp"
#include "group_image.hpp"
#include "group_renderer.hpp"
#include "visible_group.hpp"
#include "worker_needs.hpp"

namespace burin::node {
namespace {

/// What a scene may show, as far as that is known without voxels: the same on every rank.
struct Shown {
  std::vector<VisibleGroup> groups;
  std::vector<glm::vec4> clipPlanes;
  std::vector<std::uint8_t> blocks;  ///< VisibleBlocks::mark()
};

bool showsTheSame(const Scene& a, const Scene& b) {
  return a.clip == b.clip && a.clipBox == b.clipBox && a.quality.palettes == b.quality.palettes &&
         haloReach(a) == haloReach(b) && transferFunctions(a) == transferFunctions(b) &&
         shownSurfaces(a) == shownSurfaces(b) && projectedFrom(a) == projectedFrom(b) &&
         std::ranges::equal(a.layers, b.layers, {}, &Layer::labels, &Layer::labels) &&
         (!labelsNeeded(b) || labelReach(a) == labelReach(b));
}

}  // namespace

struct Worker::State {
  const Communicator& comm;
  BrickSource& source;
  Scene scene;
  WorkerOptions options;
  Rank firstOwner{0};   ///< rank of owner 0
  VolumeSurvey survey;  ///< but its blocks, which `blocks` holds
  bool isSurveyed = false;
  SurveyRequest surveyed;  ///< what the survey has
  ValueScale scale;
  VisibleBlocks blocks;
  std::vector<LabelSet> blockLabels;  ///< LabelSurvey::blocks, once a scene has needed them
  Shown shown;                        ///< by the scene
  BrickTree tree;
  int ghosts = 0;                           ///< of the bricks loaded
  bool hasLaplacian = false;                ///< the bricks loaded
  LabelMasks masks;                         ///< of the bricks loaded
  int maskReach = 0;                        ///< theirs
  std::vector<IndexBox> parts;              ///< by brick: its cells that its owner has loaded
  bool isWhole = false;                     ///< the last load went well
  std::vector<BrickId> mine;                ///< this rank's bricks
  std::optional<OffscreenContext> context;  ///< before everything that holds GL names
  std::vector<GroupRenderer> renderers;     ///< of the scene's groups
  std::vector<Brick> bricks;                ///< of mine, those of which something is loaded

  State(const Communicator& givenComm, BrickSource& givenSource, const Scene& givenScene,
        const WorkerOptions& givenOptions)
      : comm{givenComm},
        source{givenSource},
        scene{givenScene},
        options{givenOptions},
        firstOwner{givenOptions.dedicatedHost ? 1 : 0} {}

  /// The loaded brick of this rank with that id, or nullptr.
  const Brick* find(BrickId id) const {
    const auto found = std::ranges::find(bricks, id, &Brick::id);
    return found == bricks.end() ? nullptr : &*found;
  }
  const VolumeGrid& grid() const { return source.info().grid; }
  std::vector<const Brick*> beginGroup(const Camera& camera, std::size_t group,
                                       RankStatistics& statistics);

  Shown whatShows(const Scene& next) const;
  DrawingCost costOf(const Scene& next, const Shown& what) const;
  std::vector<std::uint8_t> foreseenBlocks() const;
  IndexBox neededPart(BrickId brick, std::span<const std::uint8_t> marks, int ghostLayers) const;
  bool isSplitBadly(const Scene& next, const Shown& what) const;
  bool isLoaded(const Scene& next, const Shown& what) const;
  std::size_t sharedBytes() const;
  void setRenderers();
  bool hasMasks(const Scene& next) const;
  void measure();
  void measureLabels(const Scene& next);
  void load();
  void loadParts();
  void loadMasks();
  void changeMasks();
  void dropBricks();
  void classify();
};

Shown Worker::State::whatShows(const Scene& next) const {
  Shown what;
  what.groups = visibleGroups(next, LabelMasks{next}, scale);
  what.clipPlanes = centredClipPlanes(next, grid());
  what.blocks =
      markBlocks(blocks, what.groups, blockLabels, labelReach(next), what.clipPlanes, grid());
  return what;
}

/// What the split balances. `what`: by that scene; must stay.
DrawingCost Worker::State::costOf(const Scene& next, const Shown& what) const {
  DrawnBlocks drawn;
  drawn.grid = grid();
  drawn.cubes = blocks.cubes();
  drawn.marks = what.blocks;
  drawn.views = options.views;
  drawn.stepVoxels = next.quality.stepVoxels;
  if (options.technique == Technique::kRaycast) drawn.termination = next.quality.termination;
  if (drawn.isHiding()) drawn.extinction = blocks.extinction(next, scale, what.blocks);
  return DrawingCost{std::move(drawn)};
}

/// The cells of a brick that a scene can show anything of, by its Shown::blocks; not fewer with
/// --skip off, so that both have the same textures: where a brick's texture ends changes the last
/// bits of its look-ups.
IndexBox Worker::State::neededPart(BrickId brick, std::span<const std::uint8_t> marks,
                                   int ghostLayers) const {
  const IndexBox& cells = tree.brickCells(brick);
  return options.wholeBricks ? cells : visiblePart(cells, marks, blocks.cubes(), ghostLayers);
}

/// Shown::blocks of the scene and the foreseen ones together.
std::vector<std::uint8_t> Worker::State::foreseenBlocks() const {
  std::vector<std::uint8_t> marks = shown.blocks;
  const Scene* last = &scene;
  for (const Scene& other : options.foreseen) {
    if (showsTheSame(*last, other)) continue;
    last = &other;
    const Shown what = whatShows(other);
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] |= what.blocks[i];
  }
  return marks;
}

/// Whether loading bricks anew is worth it: the split leaves one owner twice the mean cost of that
/// scene, and a new one would take a quarter off that. The same answer on every rank.
bool Worker::State::isSplitBadly(const Scene& next, const Shown& what) const {
  if (tree.ownerCount() == 1) return false;
  const DrawingCost cost = costOf(next, what);
  const double now = unevenness(tree, cost.with(tree));
  if (now <= 2) return false;
  const BrickTree other = partition(comm, cost, ghostLayers(next, options), source.info(), scale,
                                    loadsLaplacian(next, options), options);
  return unevenness(other, cost.with(other)) < 0.75 * now;
}

/// Whether the bricks hold all that a scene needs. The same answer on every rank.
bool Worker::State::isLoaded(const Scene& next, const Shown& what) const {
  const int layers = ghostLayers(next, options);
  if (!isWhole || layers > ghosts || (laplacianNeeded(next) && !hasLaplacian) ||
      !surveyed.gradients.contains(gradientOperatorsNeeded(next)))
    return false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const IndexBox needed = neededPart(BrickId{static_cast<std::uint32_t>(i)}, what.blocks, layers);
    if (!needed.empty() && !parts[i].contains(needed)) return false;
  }
  return true;
}

/// Whether the bricks' masks are those of a scene. The same answer on every rank.
bool Worker::State::hasMasks(const Scene& next) const {
  return !labelsNeeded(next) ||
         (masks.sets() == LabelMasks{next}.sets() && labelReach(next) <= maskReach);
}

/// What this rank holds beside its bricks: grows with the volume, but no further than the survey's
/// blocks do.
std::size_t Worker::State::sharedBytes() const {
  std::size_t tables = 0;
  for (const GroupRenderer& renderer : renderers) tables += renderer.tableBytes();
  return blocks.bytes() + blockLabels.size() * sizeof(LabelSet) + shown.blocks.size() + tables;
}

/// Local. This rank's loaded bricks, front to back, ready to be drawn; counts them with the first
/// group.
std::vector<const Brick*> Worker::State::beginGroup(const Camera& camera, std::size_t group,
                                                    RankStatistics& statistics) {
  std::vector<const Brick*> inOrder;
  if (!bricks.empty()) {
    context->makeCurrent();
    BURIN_CHECK(group < renderers.size());
    for (const BrickId id : tree.visibilityOrder(camera))
      if (const Brick* brick = find(id)) inOrder.push_back(brick);
  }
  if (group > 0) return inOrder;
  statistics.bricks = static_cast<std::int32_t>(mine.size());
  statistics.residentVoxelBytes += static_cast<std::int64_t>(sharedBytes());
  for (const Brick* brick : inOrder)
    statistics.residentVoxelBytes += static_cast<std::int64_t>(brick->residentBytes());
  return inOrder;
}

/// Local. Those that the scene's groups need; programs of as many as there were are kept.
void Worker::State::setRenderers() {
  const std::vector<Scene> groups = layerGroups(scene);
  const LabelMasks ofAll{scene};
  const GroupRenderer::Options how{
      {options.skip, options.countSamples, mine.size() > 1}, options.technique, options.precision};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i < renderers.size())
      renderers[i].setScene(groups[i], ofAll);
    else
      renderers.emplace_back(groups[i], ofAll, ProgramVolume{grid(), scale, survey.gradients}, how);
  }
  renderers.erase(renderers.begin() + static_cast<std::ptrdiff_t>(groups.size()), renderers.end());
}

/// Collective. The survey, and what follows from it, if the scene needs more than there is.
void Worker::State::measure() {
  const SurveyRequest needed = surveyFor(scene, options);
  if (isSurveyed && surveyed.contains(needed)) return;
  if (!isSurveyed && options.survey != nullptr && options.survey->request.contains(needed)) {
    survey = options.survey->survey;
    surveyed = options.survey->request;
  } else {
    const SurveyRequest all{surveyed.gradients | needed.gradients,
                            surveyed.laplacian || needed.laplacian};
    survey = surveyVolume(comm, source, all);  // may fail
    surveyed = all;
  }
  scale = valueScaleOf(source.info().type, survey);
  blocks = VisibleBlocks{survey, scale};
  survey.blocks = {};
  isSurveyed = true;
  renderers.clear();  // their programs know the gradients' scale
}

/// Collective. Where which labels are, if a scene is the first to ask for it.
void Worker::State::measureLabels(const Scene& next) {
  if (!labelsNeeded(next) || !blockLabels.empty()) return;
  BURIN_CHECK(options.labels != nullptr);
  BURIN_CHECK(options.labels->info().grid.dims == grid().dims);
  blockLabels = surveyLabels(comm, *options.labels).blocks;
}

void Worker::State::dropBricks() {
  bricks.clear();
  std::ranges::fill(parts, IndexBox{});
  isWhole = false;
}

/// Collective. Splits the volume for the scene and loads what it can show of this rank's bricks. If
/// that fails there are none.
void Worker::State::load() {
  if (context) context->makeCurrent();
  bricks.clear();
  isWhole = false;
  try {
    loadParts();
    isWhole = true;
  } catch (...) {
    dropBricks();
    throw;
  }
}

void Worker::State::loadParts() {
  const VolumeInfo& volume = source.info();
  measure();
  measureLabels(scene);
  for (const Scene& other : options.foreseen) measureLabels(other);
  shown = whatShows(scene);
  ghosts = ghostLayers(scene, options);
  hasLaplacian = loadsLaplacian(scene, options);
  tree = partition(comm, costOf(scene, shown), ghosts, volume, scale, hasLaplacian, options);
  parts.clear();
  const std::vector<std::uint8_t> marks = foreseenBlocks();
  for (std::size_t i = 0; i < tree.brickCount(); ++i)
    parts.push_back(neededPart(BrickId{static_cast<std::uint32_t>(i)}, marks, ghosts));
  const int owner = static_cast<int>(comm.rank()) - static_cast<int>(firstOwner);
  mine = owner >= 0 && owner < tree.ownerCount() ? tree.bricksOf(owner) : std::vector<BrickId>{};
  const auto part = [&](BrickId id) { return parts[static_cast<std::size_t>(id)]; };
  const bool draws = std::ranges::any_of(mine, [&](BrickId id) { return !part(id).empty(); });
  const int threads = threadShare(comm, draws);
  std::vector<IndexBox> boxes;
  for (const BrickId id : mine)
    if (!part(id).empty()) boxes.push_back(storedVoxels(part(id), ghosts, volume.grid));
  const MemoryNeed need = memoryNeedOf(boxes, volume, scale, hasLaplacian, LabelMasks{scene});
  checkMemory(comm, need);
  collectively(comm, "preparing to draw", [&] {
    if (!draws) return;  // an idle rank needs no OpenGL
    if (!context) context.emplace(ContextOptions{threads, options.gl});
    context->makeCurrent();
    setRenderers();
  });
  checkMemory(comm, need);  // OpenGL has taken its part by now
  collectively(comm, "making room for bricks", [&] {
    for (const BrickId id : mine) {
      if (part(id).empty()) continue;
      bricks.emplace_back(id, part(id), ghosts, volume, scale,
                          hasLaplacian ? std::optional{survey.laplacian999} : std::nullopt);
    }
  });
  loadBricks(comm, source, boxes, bricks);
  loadMasks();
  collectively(comm, "classifying bricks", [&] {
    for (Brick& brick : bricks) brick.finishLoading();
    classify();
  });
}

/// Collective. The scene's masks of the bricks that are there.
void Worker::State::loadMasks() {
  masks = LabelMasks{scene};
  maskReach = labelReach(scene);
  if (masks.sets().empty()) return;
  loadLabels(comm, *options.labels, masks, maskReach, bricks);
}

/// Collective. What load() does where the bricks' voxels stay and the scene has other labels.
void Worker::State::changeMasks() {
  try {
    collectively(comm, "changing the scene", [&] {
      if (bricks.empty()) return;
      context->makeCurrent();
      setRenderers();
    });
    loadMasks();
    collectively(comm, "classifying bricks", [&] { classify(); });
  } catch (...) {
    dropBricks();
    throw;
  }
}

/// Local. What the scene can show of each brick.
void Worker::State::classify() {
  const TraceSpan span{"classify"};
  for (Brick& brick : bricks) brick.classify(shown.groups, shown.clipPlanes);
}

Worker::Worker(const Communicator& comm, const Scene& scene, BrickSource& source,
               const WorkerOptions& options)
    : state_{std::make_unique<State>(comm, source, scene, options)} {
  collectively(comm, "the scene",
               [&] { checkTechnique(scene, options.technique, options.precision); });
  state_->load();
}

void Worker::update(const Scene& scene) {
  State& state = *state_;
  collectively(state.comm, "the scene",
               [&] { checkTechnique(scene, state.options.technique, state.options.precision); });
  state.measureLabels(scene);
  const bool sameShown = showsTheSame(state.scene, scene);
  Shown shown = sameShown ? state.shown : state.whatShows(scene);
  const bool mustLoad =
      !state.isLoaded(scene, shown) || (!sameShown && state.isSplitBadly(scene, shown));
  const Scene before = std::exchange(state.scene, scene);
  if (mustLoad) return state.load();
  std::swap(state.shown, shown);
  if (!state.hasMasks(scene)) return state.changeMasks();
  const auto apply = [&] {
    if (state.bricks.empty()) return;
    state.context->makeCurrent();
    state.setRenderers();
    if (!sameShown) state.classify();
  };
  try {
    agree(state.comm, "changing the scene", attempt(apply));
  } catch (const CollectiveError&) {
    // Also where it went well: all ranks must draw the same scene.
    state.scene = before;
    std::swap(state.shown, shown);
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
  for (const int owner : state_->tree.ownerVisibilityOrder(camera)) {
    const auto shows = [&](BrickId id) {
      return !state_->parts[static_cast<std::size_t>(id)].empty();
    };
    if (std::ranges::any_of(state_->tree.bricksOf(owner), shows))
      ranks.push_back(Rank{owner + static_cast<int>(state_->firstOwner)});
  }
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
                                            const PixelRoom& room, const StepMap* steps,
                                            std::size_t group) {
  const std::vector<const Brick*> bricks = state_->beginGroup(camera, group, statistics);
  if (bricks.empty()) return {camera.image, {}, {}};
  return state_->renderers[group].media().draw(camera, bricks, statistics, room, steps);
}

compositor::Subimage<compositor::LargestValuePixel> Worker::drawLargest(const Camera& camera,
                                                                        RankStatistics& statistics,
                                                                        std::size_t group) {
  const std::vector<const Brick*> bricks = state_->beginGroup(camera, group, statistics);
  if (bricks.empty()) return {camera.image, {}, {}};
  return state_->renderers[group].projector().largest(camera, bricks, statistics);
}

compositor::Subimage<compositor::WeightedSumPixel> Worker::drawSums(const Camera& camera,
                                                                    RankStatistics& statistics,
                                                                    std::size_t group) {
  const std::vector<const Brick*> bricks = state_->beginGroup(camera, group, statistics);
  if (bricks.empty()) return {camera.image, {}, {}};
  return state_->renderers[group].projector().sums(camera, bricks, statistics);
}

Image<Rgba> Worker::merge(std::span<const GroupImage> images) const {
  return mergeGroups(layerGroups(state_->scene), images, state_->scale);
}

compositor::SubimageView<Rgba> Worker::drawBrick(BrickId brick, const Camera& camera,
                                                 RankStatistics& statistics,
                                                 const PixelRoom& room) {
  BURIN_CHECK(std::ranges::find(state_->mine, brick) != state_->mine.end());
  statistics.bricks = 1;
  const Brick* const found = state_->find(brick);
  if (found == nullptr) return {camera.image, {}, {}};
  statistics.residentVoxelBytes += static_cast<std::int64_t>(found->residentBytes());
  state_->context->makeCurrent();
  return state_->renderers.front().media().draw(camera, {&found, 1}, statistics, room, nullptr);
}

}  // namespace burin::node
