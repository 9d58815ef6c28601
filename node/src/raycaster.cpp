#include "raycaster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "burin/common/footprint.hpp"
#include "burin/common/sample_lattice.hpp"
#include "clip_planes.hpp"
#include "visible_values.hpp"

namespace burin::node {
namespace {

constexpr float kFar = 1e30f;  // kFar in lattice.glsl
constexpr GLuint kVolumeUnit = 0;
constexpr GLuint kDistanceUnit = 1;
constexpr GLuint kFrameUnit = 2;
constexpr GLuint kFirstTransferUnit = 3;

glm::vec3 toFloat(const glm::dvec3& v) {
  return glm::vec3{v};
}

void setLookUp(const Texture& texture, GLint filter) {
  gl().TextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, filter);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, filter);
  checkGl("uploading a transfer function");
}

/// Rows of equal length as the layers of an array texture.
Texture uploadRows(std::span<const std::span<const glm::vec4>> rows) {
  Texture texture = makeTexture(GL_TEXTURE_1D_ARRAY);
  const auto width = static_cast<GLsizei>(rows.front().size());
  gl().TextureStorage2D(texture.id(), 1, GL_RGBA32F, width, static_cast<GLsizei>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    gl().TextureSubImage2D(texture.id(), 0, 0, static_cast<GLint>(i), width, 1, GL_RGBA, GL_FLOAT,
                           rows[i].data());
  setLookUp(texture, GL_LINEAR);
  return texture;
}

Texture uploadEntries(std::span<const glm::vec4> entries) {
  Texture texture = makeTexture(GL_TEXTURE_1D);
  const auto width = static_cast<GLsizei>(entries.size());
  gl().TextureStorage1D(texture.id(), 1, GL_RGBA32F, width);
  gl().TextureSubImage1D(texture.id(), 0, 0, width, GL_RGBA, GL_FLOAT, entries.data());
  setLookUp(texture, GL_NEAREST);
  return texture;
}

/// One layer's look-ups, in the order of their texture units.
std::vector<Texture> uploadTransferFunction(const TransferTable& table, bool preintegrated) {
  const TransferRows rows = transferRows(table);
  std::vector<Texture> textures;
  if (preintegrated) {
    textures.push_back(
        uploadRows(std::array<std::span<const glm::vec4>, 2>{rows.table, rows.colour}));
    textures.push_back(uploadEntries(rows.extinction));
  } else {
    textures.push_back(uploadRows(std::array<std::span<const glm::vec4>, 1>{rows.table}));
  }
  return textures;
}

/// curve[0].x is the start value; the others (x, length, slope) of each linear piece.
std::vector<glm::vec3> curvePieces(const Curve& curve) {
  std::vector<glm::vec3> pieces{{static_cast<float>(curve.points.front().y), 0, 0}};
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const glm::dvec2 from = curve.points[i - 1];
    const glm::dvec2 step = curve.points[i] - from;
    pieces.emplace_back(glm::vec3{glm::dvec3{from.x, step.x, step.y / step.x}});
  }
  return pieces;
}

ShaderSource vertexSource() {
  return expandIncludes("#version 450 core\n#include \"fullscreen.vert\"\n", "vertex program");
}

}  // namespace

Raycaster::Raycaster(const Scene& scene, const VolumeGrid& grid, const ValueScale& scale,
                     const GradientScales& gradients, const RaycastOptions& options)
    : grid_{grid},
      scale_{scale},
      gradients_{gradients},
      options_{options},
      vertexArray_{makeVertexArray()},
      framebuffer_{makeFramebuffer()} {
  if (options_.countSamples) {
    counters_ = makeBuffer();
    gl().NamedBufferStorage(counters_.id(), 4 * sizeof(GLuint), nullptr, GL_DYNAMIC_STORAGE_BIT);
  }
  setScene(scene);
}

void Raycaster::setScene(const Scene& scene) {
  const bool tablesStand = scene_.layers.size() == scene.layers.size() &&
                           scene_.quality.preintegrated == scene.quality.preintegrated &&
                           std::ranges::equal(scene_.layers, scene.layers, {},
                                              &Layer::transferFunction, &Layer::transferFunction);
  ShaderSource source = generateRaycastProgram(
      scene, {scale_.hasInvalid, options_.countSamples, options_.severalBricks});
  auto known = programs_.find(source.text);
  if (known == programs_.end())
    known = programs_.try_emplace(source.text, vertexSource(), source).first;
  program_ = &known->second;
  if (!tablesStand) {
    std::vector<TransferTable> tables = transferTables(scene, scale_);
    std::vector<Texture> textures;
    for (const TransferTable& table : tables)
      std::ranges::move(uploadTransferFunction(table, scene.quality.preintegrated),
                        std::back_inserter(textures));
    tables_ = std::move(tables);
    transferTextures_ = std::move(textures);
  }
  scene_ = scene;
  setSceneUniforms();
}

void Raycaster::setSceneUniforms() {
  program_->set("volume", static_cast<int>(kVolumeUnit));
  program_->set("distanceMap", static_cast<int>(kDistanceUnit));
  program_->set("frame", static_cast<int>(kFrameUnit));
  program_->set("skipEmpty", options_.skip ? 1.0f : 0.0f);
  program_->set("one", 1.0f);
  program_->set("termination", static_cast<float>(scene_.quality.termination));
  const Box box = grid_.boxIndex();
  const glm::dvec3 centre = grid_.centreIndex();
  program_->set("boxLo", toFloat(box.lo - centre));
  program_->set("boxHi", toFloat(box.hi - centre));

  program_->set("clipPlane", centredClipPlanes(scene_, grid_));

  // Differences of stored values at ±1 voxel → world gradient over gradientUnit().
  program_->set("differencesToGradient", glm::mat3{glm::transpose(grid_.worldToIndex()) *
                                                   (0.5 * scale_.range / gradientUnit())});

  std::vector<glm::vec3> lightColours;
  for (const Light& light : scene_.lights)
    lightColours.push_back(toFloat(light.colour.linear() * light.intensity));
  program_->set("lightColours", lightColours);
  for (std::size_t i = 0; i < scene_.layers.size(); ++i) setStyleUniforms(i);
}

double Raycaster::gradientUnit() const {
  if (gradients_.percentile > 0) return gradients_.percentile;
  return gradients_.maximum > 0 ? gradients_.maximum : 1.0;
}

void Raycaster::setStyleUniforms(std::size_t layer) {
  const TransferTable& table = tables_[layer];
  const auto bins = static_cast<double>(table.entries.size() - 1);
  program_->set(visibleBinsUniform(layer), glm::vec2{table.visibleBins()});
  const std::size_t perLayer = transferTextures_.size() / tables_.size();
  const std::size_t firstUnit = kFirstTransferUnit + layer * perLayer;
  program_->set(transferUniform(layer), static_cast<int>(firstUnit));
  if (perLayer > 1) program_->set(extinctionUniform(layer), static_cast<int>(firstUnit + 1));
  program_->set(transferScaleUniform(layer),
                glm::vec4{glm::dvec4{scale_.stored(table.first),
                                     bins * scale_.range / (table.last - table.first), bins,
                                     1 / (bins + 2)}});

  const StyleSettings gradient = [&] {
    const StyleSettings* own = scene_.layers[layer].style("gradient");
    return own != nullptr ? *own : defaultSettings(*findStyle("gradient"));
  }();
  const bool byMaximum = gradient.word("magnitude") == "maximum";
  const double unit = byMaximum ? gradients_.maximum : gradients_.percentile;
  program_->set(magnitudeUniform(layer),
                static_cast<float>(unit > 0 ? gradientUnit() / unit : 0.0));
  program_->set(parameterUniform(layer, "gradient", "noise_floor"),
                static_cast<float>(gradient.number("noise_floor")));

  for (const StyleSettings& settings : scene_.layers[layer].styles) {
    const StyleSpec& style = *findStyle(settings.name);
    for (std::size_t i = 0; i < style.parameters.size(); ++i) {
      const std::string_view parameter = style.parameters[i].name;
      const std::string name = parameterUniform(layer, style.name, parameter);
      if (const auto* number = std::get_if<double>(&settings.values[i]))
        program_->set(name, static_cast<float>(*number));
      else if (const auto* colour = std::get_if<Colour>(&settings.values[i]))
        program_->set(name, toFloat(colour->linear()));
      else if (const auto* curve = std::get_if<Curve>(&settings.values[i]))
        program_->set(curveUniform(layer, style.name, parameter), curvePieces(*curve));
    }
  }
}

void Raycaster::setStepUniforms(const Camera& camera, double stepVoxels) {
  const SampleLattice lattice = makeSampleLattice(camera, grid_, stepVoxels);
  program_->set("exitMargin", static_cast<float>(1e-3 / std::max(stepVoxels, 1.0)));
  program_->set("base", toFloat(lattice.base));
  program_->set("baseX", toFloat(lattice.baseX));
  program_->set("baseY", toFloat(lattice.baseY));
  program_->set("along", toFloat(lattice.step));
  program_->set("alongX", toFloat(lattice.stepX));
  program_->set("alongY", toFloat(lattice.stepY));
  program_->set("nearPlane", std::max(static_cast<float>(lattice.nearPlane), -kFar));
  program_->set("stepWorld", static_cast<float>(lattice.stepWorld));
}

void Raycaster::setViewUniforms(const Camera& camera) {
  const double slope = camera.projection == Projection::kPerspective ? camera.pixelSize : 0.0;
  program_->set("imageCentre", glm::vec2{0.5f * static_cast<float>(camera.image.width),
                                         0.5f * static_cast<float>(camera.image.height)});
  program_->set("pixelSlope", static_cast<float>(slope));
  program_->set("eyeward", toFloat(-camera.forward));
  program_->set("eyewardX", toFloat(-slope * camera.right));
  program_->set("eyewardY", toFloat(slope * camera.up));
  std::vector<glm::vec3> lights;
  for (const Light& light : scene_.lights)
    lights.push_back(toFloat(lightDirectionWorld(light, camera)));
  program_->set("lightDirections", lights);
}

void Raycaster::setBrickUniforms(const Brick& brick) {
  const glm::dvec3 centre = grid_.centreIndex();
  const glm::ivec3 cells = grid_.cells();
  glm::vec3 lo = toFloat(glm::dvec3{brick.cells().lo} - centre);
  glm::vec3 hi = toFloat(glm::dvec3{brick.cells().hi} - centre);
  for (int axis = 0; axis < 3; ++axis) {
    if (brick.cells().lo[axis] == 0) lo[axis] = -kFar;
    if (brick.cells().hi[axis] == cells[axis]) hi[axis] = kFar;
  }
  program_->set("brickLo", lo);
  program_->set("brickHi", hi);
  const IndexBox& stored = brick.storedVoxels();
  program_->set("textureOffset", toFloat(centre - glm::dvec3{stored.lo} + 0.5));
  program_->set("textureScale", toFloat(1.0 / glm::dvec3{stored.size()}));
  program_->set("cellOffset", toFloat(centre - glm::dvec3{brick.mapOrigin()}));
  gl().BindTextureUnit(kVolumeUnit, brick.volumeTexture());
  gl().BindTextureUnit(kDistanceUnit, brick.distanceTexture());
}

void Raycaster::resizeTarget(ImageSize size) {
  if (size == targetSize_) return;
  target_ = makeTexture(GL_TEXTURE_2D);
  gl().TextureStorage2D(target_.id(), 1, GL_RGBA32F, size.width, size.height);
  gl().NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, target_.id(), 0);
  const GLenum status = gl().CheckNamedFramebufferStatus(framebuffer_.id(), GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    fail(ExitCode::kRank, "no float target of {}x{} pixels (OpenGL status {:#x})", size.width,
         size.height, status);
  targetSize_ = size;
}

void Raycaster::drawPixels(const PixelRect& pixels, double stepVoxels, RankStatistics& statistics) {
  if (!options_.countSamples) {
    gl().Scissor(pixels.x0, pixels.y0, pixels.width(), pixels.height());
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  // The counters are 32 bits wide: bands of rows whose rays cannot have more samples than that.
  const double planes = 2 * grid_.boundingRadius() / (stepVoxels * grid_.smallestSpacing()) + 2;
  const int rows = std::max(1, static_cast<int>(0x1p32 / planes / pixels.width()));
  for (int y = pixels.y0; y < pixels.y1; y += rows) {
    constexpr std::array<GLuint, 4> kZero{};
    gl().NamedBufferSubData(counters_.id(), 0, sizeof(kZero), kZero.data());
    gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counters_.id());
    gl().Scissor(pixels.x0, y, pixels.width(), std::min(rows, pixels.y1 - y));
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    addCounters(statistics);
  }
}

void Raycaster::addCounters(RankStatistics& statistics) {
  std::array<GLuint, 4> counts{};
  gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl().GetNamedBufferSubData(counters_.id(), 0, sizeof(counts), counts.data());
  statistics.samplesVisited += counts[0];
  statistics.samplesShaded += counts[1];
  statistics.samplesInOccupiedCells += counts[2];
  statistics.leaps += counts[3];
}

compositor::SubimageView<Rgba> Raycaster::draw(
    const Camera& camera, std::span<const Brick* const> bricks, RankStatistics& statistics,
    const std::function<std::span<Rgba>(std::size_t)>& room, const StepMap* steps) {
  compositor::SubimageView<Rgba> subimage{camera.image, {}, {}};
  struct Job {
    const Brick* brick;
    PixelRect pixels;
  };
  std::vector<Job> jobs;
  for (const Brick* brick : bricks) {
    const IndexBox& cells = options_.skip ? brick->visibleCells() : brick->cells();
    if (cells.empty()) continue;
    const PixelRect pixels = footprint(camera, grid_, cells);
    if (pixels.empty()) continue;
    jobs.push_back({brick, pixels});
    subimage.active = boundingRect(subimage.active, pixels);
  }
  if (jobs.empty()) return subimage;

  resizeTarget(camera.image);
  setViewUniforms(camera);
  program_->use();
  gl().BindVertexArray(vertexArray_.id());
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl().Viewport(0, 0, camera.image.width, camera.image.height);
  gl().Enable(GL_SCISSOR_TEST);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);  // front to back, premultiplied
  const PixelRect& area = subimage.active;
  gl().Scissor(area.x0, area.y0, area.width(), area.height());
  constexpr std::array<float, 4> kNothing{};
  gl().ClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, kNothing.data());
  for (std::size_t i = 0; i < transferTextures_.size(); ++i)
    gl().BindTextureUnit(kFirstTransferUnit + static_cast<GLuint>(i), transferTextures_[i].id());
  gl().BindTextureUnit(kFrameUnit, target_.id());
  double step = 0;
  for (const Job& job : jobs) {
    gl().TextureBarrier();  // the next brick reads what this one drew, each pixel its own
    setBrickUniforms(*job.brick);
    std::vector<StepRun> runs{{scene_.quality.stepVoxels, job.pixels}};
    if (steps != nullptr) runs = stepRuns(*steps, job.pixels);
    for (const StepRun& run : runs) {
      if (run.step != step) setStepUniforms(camera, run.step);
      step = run.step;
      drawPixels(run.pixels, step, statistics);
    }
  }
  const std::span<Rgba> pixels = room(area.pixels());
  gl().ReadPixels(area.x0, area.y0, area.width(), area.height(), GL_RGBA, GL_FLOAT, pixels.data());
  subimage.pixels = pixels;
  checkGl("drawing");
  return subimage;
}

}  // namespace burin::node
