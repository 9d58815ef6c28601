#include "slicer.hpp"

#include <algorithm>
#include <cmath>

namespace burin::node {
namespace {

GLenum formatOf(Precision precision) {
  if (precision == Precision::kHalf) return GL_RGBA16F;
  return precision == Precision::kByte ? GL_RGBA8 : GL_RGBA32F;
}

bool belongsTo(const StyleSettings& settings, LayerPass pass) {
  const StyleSpec& style = *findStyle(settings.name);
  const StylePasses others = pass == LayerPass::kLines ? StylePasses::kColour : StylePasses::kLines;
  return !style.hasSnippet || style.passes != others;
}

/// The scene with that layer alone, and of its styles those of the pass.
Scene sceneOfPass(const Scene& scene, std::size_t layer, LayerPass pass) {
  Scene part = scene;
  part.layers = {scene.layers[layer]};
  std::erase_if(part.layers.front().styles,
                [&](const StyleSettings& settings) { return !belongsTo(settings, pass); });
  return part;
}

/// How many of the scene's transferFunctions() belong to layers before that one.
std::size_t functionsBefore(const Scene& scene, std::size_t layer) {
  Scene before = scene;
  before.layers.resize(layer);
  return transferFunctions(before).size();
}

void scissor(const PixelRect& pixels) {
  gl().Scissor(pixels.x0, pixels.y0, pixels.width(), pixels.height());
}

}  // namespace

Slicer::Slicer(const Scene& scene, const LabelMasks& masks, const ProgramVolume& volume,
               const DrawOptions& options, Precision precision)
    : volume_{volume},
      options_{options},
      vertexArray_{makeVertexArray()},
      target_{formatOf(precision)} {
  if (options_.countSamples) counters_.emplace();
  setScene(scene, masks);
}

GlProgram* Slicer::program(const std::string& key, const ShaderSource& source) {
  auto known = programs_.find(key + source.text);
  if (known == programs_.end())
    known = programs_.try_emplace(key + source.text, fullscreenVertexSource(), source).first;
  return &known->second;
}

Slicer::Pass Slicer::makePass(const Scene& scene, std::size_t layer, LayerPass kind,
                              SliceTarget target) {
  const Scene part = sceneOfPass(scene, layer, kind);
  const ShaderSource source =
      generateSliceProgram(part, kind, target, {volume_.scale.hasInvalid, options_.countSamples});
  return {layer, kind, program(std::to_string(layer), source)};
}

void Slicer::setScene(const Scene& scene, const LabelMasks& masks) {
  const auto lined =
      static_cast<std::size_t>(std::ranges::count_if(scene.layers, &Layer::hasLines));
  const bool isDirect = scene.quality.combine == Combine::kOver || scene.layers.size() + lined == 1;
  const SliceTarget target = isDirect ? SliceTarget::kFrame : SliceTarget::kLayerImage;
  std::vector<Pass> passes;
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    passes.push_back(makePass(scene, i, LayerPass::kColour, target));
    if (scene.layers[i].hasLines()) passes.push_back(makePass(scene, i, LayerPass::kLines, target));
  }
  GlProgram* const resolve =
      isDirect ? nullptr : program("", generateResolveProgram(scene.layers.size()));
  textures_.set(scene, volume_.scale);

  passes_ = std::move(passes);
  resolve_ = resolve;
  scene_ = scene;
  for (const Pass& pass : passes_) {
    const std::size_t first = functionsBefore(scene_, pass.layer);
    const Scene part = sceneOfPass(scene_, pass.layer, pass.kind);
    setSceneUniforms(*pass.program, part, volume_,
                     textures_.tables().subspan(first, transferFunctions(part).size()),
                     kFirstTransferUnit + kUnitsPerFunction * static_cast<GLuint>(first));
    pass.program->set(maskUniform(0), static_cast<float>(masks.of(scene_.layers[pass.layer])));
    pass.program->set("skipEmpty", options_.skip ? 1.0f : 0.0f);
  }
}

compositor::SubimageView<Rgba> Slicer::draw(const Camera& camera,
                                            std::span<const Brick* const> bricks,
                                            RankStatistics& statistics, const PixelRoom& room,
                                            const StepMap* steps) {
  std::vector<BrickJob> jobs = brickJobs(camera, volume_.grid, bricks, options_.skip);
  const PixelRect area = activeArea(jobs);
  if (jobs.empty()) return {camera.image, area, {}};

  target_.resize(camera.image);
  target_.begin(area);
  gl().BindVertexArray(vertexArray_.id());
  textures_.bind(kFirstTransferUnit);
  if (resolve_ != nullptr) {
    const GLuint unit =
        kFirstTransferUnit + kUnitsPerFunction * static_cast<GLuint>(textures_.tables().size());
    images_.resize(camera.image, scene_.layers.size());
    gl().BindTextureUnit(unit, images_.texture());
    resolve_->set("layerImages", static_cast<int>(unit));
  }
  if (counters_) counters_->begin();
  counted_ = 0;
  for (const Pass& pass : passes_)
    setViewUniforms(*pass.program, sceneOfPass(scene_, pass.layer, pass.kind), camera,
                    volume_.grid);
  std::ranges::reverse(jobs);  // back to front
  for (const BrickJob& job : jobs) {
    bindTextures(*job.brick);
    for (const Pass& pass : passes_)
      setBrickUniforms(*pass.program, sceneOfPass(scene_, pass.layer, pass.kind), volume_.grid,
                       *job.brick);
    for (const StepRun& run : stepRuns(job, scene_.quality.stepVoxels, steps)) {
      for (const Pass& pass : passes_)
        setStepUniforms(*pass.program, camera, volume_.grid, run.step);
      drawSlices(camera,
                 {options_.skip ? job.brick->visibleCells() : job.brick->cells(),
                  makeSampleLattice(camera, volume_.grid, run.step), run.pixels},
                 statistics);
    }
  }
  if (counters_) counters_->addTo(statistics);
  const std::span<const Rgba> pixels = target_.read(area, room);
  checkGl("drawing");
  return {camera.image, area, pixels};
}

void Slicer::drawSlices(const Camera& camera, const Slices& slices, RankStatistics& statistics) {
  // In planes, and by how much more than rounding may move a sample (sample_lattice.hpp).
  constexpr double kMargin = 0.01;
  const SampleLattice& lattice = slices.lattice;
  const auto planeDepth = [&](double plane) {
    return (static_cast<double>(lattice.reference) + plane) * lattice.stepWorld;
  };
  const DepthRange depths = depthRange(camera, volume_.grid, slices.cells);
  const auto planeAt = [&](double depth) {
    return depth / lattice.stepWorld - static_cast<double>(lattice.reference);
  };
  const double first = std::max(std::floor(planeAt(depths.nearest) - kMargin), lattice.nearPlane);
  const double last = std::floor(planeAt(depths.farthest) + kMargin);
  for (double slice = last; slice >= first; --slice) {
    const DepthRange slab{planeDepth(slice - kMargin), planeDepth(slice + 1 + kMargin)};
    const PixelRect pixels =
        intersection(footprint(camera, volume_.grid, slices.cells, slab), slices.pixels);
    if (pixels.empty()) continue;
    scissor(pixels);
    if (counters_) count(static_cast<std::int64_t>(pixels.pixels()), statistics);
    drawSlice(static_cast<int>(slice));
  }
}

/// The counters are 32 bits wide: they are emptied before a slice might be too much for them.
void Slicer::count(std::int64_t fragments, RankStatistics& statistics) {
  const std::int64_t most = fragments * static_cast<std::int64_t>(passes_.size());
  if (counted_ + most > std::int64_t{1} << 32) {
    counters_->addTo(statistics);
    counters_->begin();
    counted_ = 0;
  }
  counted_ += most;
}

void Slicer::drawSlice(int slice) {
  for (const Pass& pass : passes_) {
    pass.program->set("slice", slice);
    if (resolve_ != nullptr)
      drawToLayerImage(pass);
    else
      drawOverFrame(*pass.program);
  }
  if (resolve_ != nullptr) drawOverFrame(*resolve_);
}

void Slicer::drawOverFrame(const GlProgram& program) {
  target_.bind();
  program.use();
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
}

void Slicer::drawToLayerImage(const Pass& pass) {
  images_.bind(pass.layer);
  pass.program->use();
  if (pass.kind == LayerPass::kColour) {
    gl().Disable(GL_BLEND);
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  // Lines replace colour by their amount, and what is denser counts (drawLines in shading.glsl).
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE_MINUS_SRC1_COLOR);
  gl().BlendEquationSeparate(GL_FUNC_ADD, GL_MAX);
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
  gl().BlendEquation(GL_FUNC_ADD);
}

}  // namespace burin::node
