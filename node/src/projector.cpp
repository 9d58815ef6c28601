#include "projector.hpp"

#include <limits>

#include "burin/common/error.hpp"
#include "program_generator.hpp"

namespace burin::node {

Projector::Projector(const Scene& scene, const ProgramVolume& volume, const DrawOptions& options)
    : volume_{volume}, options_{options}, vertexArray_{makeVertexArray()} {
  if (options_.countSamples) counters_.emplace();
  setScene(scene);
}

void Projector::setScene(const Scene& scene) {
  const ShaderSource source =
      generateProjectionProgram(scene, {volume_.scale.hasInvalid, options_.countSamples});
  auto known = programs_.find(source.text);
  if (known == programs_.end())
    known = programs_.try_emplace(source.text, fullscreenVertexSource(), source).first;
  program_ = &known->second;
  scene_ = scene;
  setSceneUniforms(*program_, scene_, volume_, {}, kFirstTransferUnit);
  program_->set("skipEmpty", options_.skip ? 1.0f : 0.0f);
}

template <typename Pixel>
compositor::Subimage<Pixel> Projector::draw(const Camera& camera,
                                            std::span<const Brick* const> bricks,
                                            RankStatistics& statistics) {
  constexpr std::size_t kChannels = sizeof(Pixel) / sizeof(float);
  constexpr bool kIsLargest = kChannels == 1;
  const std::vector<BrickJob> jobs = brickJobs(camera, volume_.grid, bricks, options_.skip);
  const PixelRect area = activeArea(jobs);
  compositor::Subimage<Pixel> image{camera.image, area, {}};
  if (jobs.empty()) return image;

  target_.resize(camera.image);
  const float nothing = kIsLargest ? -std::numeric_limits<float>::infinity() : 0.0f;
  target_.begin(area, {nothing, nothing, nothing, nothing});
  setViewUniforms(*program_, scene_, camera, volume_.grid);
  const double step = scene_.quality.stepVoxels;
  setStepUniforms(*program_, camera, volume_.grid, step);
  program_->use();
  gl().BindVertexArray(vertexArray_.id());
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE);
  gl().BlendEquation(kIsLargest ? GL_MAX : GL_FUNC_ADD);
  for (const BrickJob& job : jobs) {
    setBrickUniforms(*program_, scene_, volume_.grid, *job.brick);
    bindTextures(*job.brick);
    drawFullscreen(counters_, job.pixels, mostPlanes(volume_.grid, step), statistics);
  }
  gl().BlendEquation(GL_FUNC_ADD);
  image.pixels.resize(area.pixels());
  target_.read(area, kIsLargest ? GL_RED : GL_RG,
               {reinterpret_cast<float*>(image.pixels.data()), kChannels * area.pixels()});
  checkGl("drawing");
  return image;
}

compositor::Subimage<compositor::LargestValuePixel> Projector::largest(
    const Camera& camera, std::span<const Brick* const> bricks, RankStatistics& statistics) {
  BURIN_CHECK(scene_.layers.front().mode == LayerMode::kMip);
  return draw<compositor::LargestValuePixel>(camera, bricks, statistics);
}

compositor::Subimage<compositor::WeightedSumPixel> Projector::sums(
    const Camera& camera, std::span<const Brick* const> bricks, RankStatistics& statistics) {
  BURIN_CHECK(scene_.layers.front().mode == LayerMode::kAverage);
  return draw<compositor::WeightedSumPixel>(camera, bricks, statistics);
}

}  // namespace burin::node
