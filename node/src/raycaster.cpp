#include "raycaster.hpp"

#include <algorithm>
#include <cmath>

#include "program_generator.hpp"
#include "program_needs.hpp"
#include "uniform_names.hpp"

namespace burin::node {
namespace {

/// Look-ups of a segment in the adaptive march: two for each node of its tree of halves (kUnits in
/// adaptive.glsl); in cells, of which a segment crosses no more than 16 or so, each in up to three
/// stretches, only three but where there are voxels that are not valid.
constexpr double kMostOfTree = 2 * (2 * 512);
constexpr double kMostOfTreeWithInvalid = 2 * (2 * 8192);
constexpr double kMostOfCells = 16 * 3;
/// And on fixed steps for each surface (kMostLooks in surface_march.glsl), after which the rest of
/// the segment is looked up again.
constexpr double kMostOfSurface = 24 + 2;
/// How much of max_error the halving of one part may change, as a ray has many parts whose errors
/// add up; less in cells, where halving takes no look-ups.
constexpr double kToleranceOfPart = 1.0 / 10;
constexpr double kToleranceInCell = 1.0 / 32;
/// A transfer function is steep if its extinction, per smallest spacing, changes by more over as
/// much of the values as the volume's range. At 9, thin wires (stent) were off by 1.5 times 1/128
/// without cuts at cells' faces; at 2, vessels by 1.7 times 1/512.
constexpr double kSteep = 6;
constexpr double kSteepBelow = 1.0 / 256;  ///< max_error below which less is steep
constexpr double kSteepThere = 1;

/// Whether some layer may show much of what lies between two values that are close.
bool isSteep(const Scene& scene, const ProgramVolume& volume) {
  if (hasSurfaces(scene)) return true;
  const double steep = scene.quality.maxError.value_or(1) < kSteepBelow ? kSteepThere : kSteep;
  for (const TransferFunction& function : transferFunctions(scene)) {
    const double unit = function.opacityUnitLength.value();
    const auto& points = function.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double change = std::abs(extinctionFromOpacity(points[i].opacity, unit) -
                                     extinctionFromOpacity(points[i - 1].opacity, unit));
      const double width = points[i].value - points[i - 1].value;
      if (change * volume.grid.smallestSpacing() * volume.scale.range > steep * width) return true;
    }
  }
  return false;
}

double mostSamplesOfSegment(const Scene& scene, const ProgramVolume& volume, bool steep) {
  if (!isAdaptive(scene.quality))
    return 1 + kMostOfSurface * static_cast<double>(shownSurfaces(scene).size());
  if (volume.scale.hasInvalid) return (steep ? kMostOfCells : 1) * kMostOfTreeWithInvalid;
  return steep ? kMostOfCells : kMostOfTree;
}

}  // namespace

Raycaster::Raycaster(const Scene& scene, const LabelMasks& masks, const ProgramVolume& volume,
                     const DrawOptions& options)
    : volume_{volume}, options_{options}, vertexArray_{makeVertexArray()} {
  if (options_.countSamples) counters_.emplace();
  setScene(scene, masks);
}

void Raycaster::setScene(const Scene& scene, const LabelMasks& masks) {
  const bool steep = isSteep(scene, volume_);
  ShaderSource source = generateRaycastProgram(
      scene, {volume_.scale.hasInvalid, options_.countSamples, options_.severalBricks, steep});
  auto known = programs_.find(source.text);
  if (known == programs_.end())
    known = programs_.try_emplace(source.text, fullscreenVertexSource(), source).first;
  textures_.set(scene, volume_.scale);
  program_ = &known->second;
  scene_ = scene;
  mostSamplesOfSegment_ = mostSamplesOfSegment(scene, volume_, steep);
  setSceneUniforms(*program_, scene_, volume_, textures_.tables(), kFirstTransferUnit);
  for (std::size_t i = 0; i < scene_.layers.size(); ++i)
    program_->set(maskUniform(i), static_cast<float>(masks.of(scene_.layers[i])));
  program_->set("frame", static_cast<int>(kFrameUnit));
  program_->set("skipEmpty", options_.skip ? 1.0f : 0.0f);
  program_->set("termination", static_cast<float>(scene_.quality.termination));
  if (isAdaptive(scene_.quality))
    program_->set("tolerance", static_cast<float>((steep ? kToleranceInCell : kToleranceOfPart) *
                                                  *scene_.quality.maxError));
}

compositor::SubimageView<Rgba> Raycaster::draw(const Camera& camera,
                                               std::span<const Brick* const> bricks,
                                               RankStatistics& statistics, const PixelRoom& room,
                                               const StepMap* steps) {
  const std::vector<BrickJob> jobs = brickJobs(camera, volume_.grid, bricks, options_.skip);
  const PixelRect area = activeArea(jobs);
  if (jobs.empty()) return {camera.image, area, {}};

  target_.resize(camera.image);
  target_.begin(area);
  setViewUniforms(*program_, scene_, camera, volume_.grid);
  program_->use();
  gl().BindVertexArray(vertexArray_.id());
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);  // front to back, premultiplied
  textures_.bind(kFirstTransferUnit);
  gl().BindTextureUnit(kFrameUnit, target_.texture());
  double step = 0;
  for (const BrickJob& job : jobs) {
    gl().TextureBarrier();  // the next brick reads what this one drew, each pixel its own
    setBrickUniforms(*program_, scene_, volume_.grid, *job.brick);
    bindTextures(*job.brick);
    for (const StepRun& run : stepRuns(job, scene_.quality.stepVoxels, steps)) {
      if (run.step != step) setStepUniforms(*program_, camera, volume_.grid, run.step);
      step = run.step;
      drawFullscreen(counters_, run.pixels, mostPlanes(volume_.grid, step) * mostSamplesOfSegment_,
                     statistics);
    }
  }
  const std::span<const Rgba> pixels = target_.read(area, room);
  checkGl("drawing");
  return {camera.image, area, pixels};
}

}  // namespace burin::node
