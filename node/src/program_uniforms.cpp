#include "program_uniforms.hpp"

#include <algorithm>

#include "burin/common/sample_lattice.hpp"
#include "clip_planes.hpp"
#include "curve_code.hpp"
#include "direction_palette.hpp"
#include "program_needs.hpp"
#include "transfer_textures.hpp"
#include "uniform_names.hpp"
#include "widget_code.hpp"

namespace burin::node {
namespace {

constexpr float kFar = 1e30f;  // kFar in lattice.glsl

glm::vec3 toFloat(const glm::dvec3& v) {
  return glm::vec3{v};
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

/// The elements of rampsUniform().
std::vector<glm::vec3> colourRamps(const ColourCurve& curve) {
  std::vector<glm::vec3> ramps{glm::vec3{0}};
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const double from = curve.points[i - 1].x;
    const double length = curve.points[i].x - from;
    ramps.emplace_back(glm::vec3{glm::dvec3{from, length, 1 / length}});
  }
  return ramps;
}

/// The first colour, then each one's difference to the one before.
std::vector<glm::vec3> colourSteps(const ColourCurve& curve) {
  std::vector<glm::vec3> steps;
  glm::dvec3 before{0};
  for (const ColourPoint& point : curve.points) {
    steps.push_back(toFloat(point.colour.linear() - before));
    before = point.colour.linear();
  }
  return steps;
}

/// placeUniform() of a style: view depth from one side of the bounding sphere to the other, or the
/// part of the box's extent along an axis.
glm::vec4 placeOf(const StyleSettings& style, const Camera& camera, const VolumeGrid& grid) {
  const bool byView = style.word("along") == "view";
  const glm::dvec3 world = byView ? camera.forward : glm::normalize(style.direction("axis"));
  const glm::dvec3 perVoxel = glm::transpose(grid.indexToWorld()) * world;
  const Box box = grid.boxIndex();
  const double extent =
      byView ? 2 * grid.boundingRadius() : glm::dot(glm::abs(perVoxel), box.hi - box.lo);
  return glm::vec4{glm::dvec4{perVoxel / extent, 0.5}};
}

/// World gradient magnitude that counts as 1 in a program before a layer's own scale.
double gradientUnit(const PerGradientOperator<GradientScales>& gradients) {
  for (const GradientOperator which : kAllGradientOperators)
    if (gradients[which].percentile > 0) return gradients[which].percentile;
  for (const GradientOperator which : kAllGradientOperators)
    if (gradients[which].maximum > 0) return gradients[which].maximum;
  return 1;
}

void setTransferUniforms(const GlProgram& program, const TransferTable& table,
                         const ValueScale& scale, std::size_t number, GLuint unit) {
  const auto bins = static_cast<double>(table.entries.size() - 1);
  program.set(visibleBinsUniform(number), glm::vec2{table.visibleBins()});
  program.set(transferUniform(number), static_cast<int>(unit));
  program.set(extinctionUniform(number), static_cast<int>(unit + 1));
  program.set(
      transferScaleUniform(number),
      glm::vec4{glm::dvec4{scale.stored(table.first),
                           bins * scale.range / (table.last - table.first), bins, 1 / (bins + 2)}});
}

void setColourCurve(const GlProgram& program, const std::string& uniform,
                    const ColourCurve& curve) {
  program.set(uniform, colourSteps(curve));
  program.set(rampsUniform(uniform), colourRamps(curve));
}

StyleSettings gradientSettings(const Layer& layer) {
  const StyleSettings* own = layer.style("gradient");
  return own != nullptr ? *own : defaultSettings(*findStyle("gradient"));
}

/// World gradient magnitude that counts as 1 in a layer.
double gradientUnitOf(const Layer& layer, const PerGradientOperator<GradientScales>& gradients) {
  const GradientScales& scales = gradients[gradientOperator(layer)];
  return gradientSettings(layer).word("magnitude") == "maximum" ? scales.maximum
                                                                : scales.percentile;
}

void setStyleUniforms(const GlProgram& program, const Layer& layer,
                      const PerGradientOperator<GradientScales>& gradients, std::size_t number) {
  const StyleSettings gradient = gradientSettings(layer);
  const double unit = gradientUnitOf(layer, gradients);
  program.set(magnitudeUniform(number),
              static_cast<float>(unit > 0 ? gradientUnit(gradients) / unit : 0.0));
  program.set(parameterUniform(number, "gradient", "noise_floor"),
              static_cast<float>(gradient.number("noise_floor")));

  for (const StyleSettings& settings : layer.styles) {
    const StyleSpec& style = *findStyle(settings.name);
    for (std::size_t i = 0; i < style.parameters.size(); ++i) {
      const std::string_view parameter = style.parameters[i].name;
      const std::string name = parameterUniform(number, style.name, parameter);
      if (const auto* real = std::get_if<double>(&settings.values[i]))
        program.set(name, static_cast<float>(*real));
      else if (const auto* colour = std::get_if<Colour>(&settings.values[i]))
        program.set(name, toFloat(colour->linear()));
      else if (const auto* curve = std::get_if<Curve>(&settings.values[i]))
        program.set(curveUniform(number, style.name, parameter), curvePieces(*curve));
      else if (const auto* colours = std::get_if<ColourCurve>(&settings.values[i]))
        setColourCurve(program, curveUniform(number, style.name, parameter), *colours);
    }
  }
}

void setHaloUniforms(const GlProgram& program, const Layer& layer, const ProgramVolume& volume,
                     std::size_t number) {
  const StyleSettings* halo = layer.style("halo");
  if (halo == nullptr) return;
  const StyleSettings gradient = gradientSettings(layer);
  const HaloNeighbourhood around = haloNeighbourhood(*halo);
  const double difference = volume.scale.range / (2 * around.aside * volume.grid.smallestSpacing());
  const double unit = gradientUnitOf(layer, volume.gradients);
  const auto set = [&](const char* member, double value) {
    program.set(haloUniform(number) + "." + member, static_cast<float>(value));
  };
  set("radius", around.radius);
  set("aside", around.aside);
  set("toMagnitude", unit > 0 ? difference / unit : 0.0);
  set("noiseFloor", gradient.number("noise_floor"));
  set("outward", gradient.word("normal") == "inward" ? -1 : 1);
  set("unitLength", layer.transferFunction.opacityUnitLength.value());
  set("directionPower", halo->number("direction_power"));
  set("edgePower", halo->number("edge_power"));
}

void setDirectionPalette(const GlProgram& program) {
  const DirectionPalette palette = directionPalette();
  std::vector<glm::vec3> mirrors, directions;
  for (const glm::dvec3& mirror : palette.mirrors) mirrors.push_back(toFloat(mirror));
  for (const glm::dvec3& direction : palette.directions) directions.push_back(toFloat(direction));
  program.set("mirrors", mirrors);
  program.set("paletteDirections", directions);
}

void setSurfaceUniforms(const GlProgram& program, const Scene& scene, const ValueScale& scale) {
  std::vector<float> values;
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = scene.layers[i];
    if (layer.mode != LayerMode::kIso) continue;
    values.push_back(static_cast<float>(scale.stored(layer.isoValue.value())));
    const glm::dvec3 colour = layer.transferFunction.lookUp(layer.isoValue.value()).colour;
    program.set(isoColourUniform(i), glm::vec4{glm::dvec4{colour, layer.isoOpacity}});
    program.set(isoLineOpacityUniform(i), static_cast<float>(layer.isoLineOpacity()));
  }
  program.set("isoValue", values);
}

/// `textureOffset`: of that name in volume.glsl.
void setCapUniforms(const GlProgram& program, const Scene& scene, const VolumeGrid& grid,
                    const IndexBox& storedVoxels, const glm::dvec3& textureOffset) {
  std::vector<glm::vec4> planes;
  std::vector<glm::vec3> directions;
  for (const ClipPlane& plane : cappedPlanes(scene)) {
    const double length = glm::length(plane.normal);
    directions.push_back(toFloat(plane.normal / length));
    // n·x + d with x = centreWorld + M p, p = size * coordinate - textureOffset.
    const double depth = kCapVoxels * grid.smallestSpacing() * length;
    const glm::dvec3 normal = glm::transpose(grid.indexToWorld()) * plane.normal / depth;
    const double offset = (glm::dot(plane.normal, grid.centreWorld()) + plane.offset) / depth -
                          glm::dot(normal, textureOffset);
    planes.emplace_back(glm::vec4{glm::dvec4{normal * glm::dvec3{storedVoxels.size()}, offset}});
  }
  program.set("capPlanes", planes);
  program.set("capDirections", directions);
}

}  // namespace

void setSceneUniforms(const GlProgram& program, const Scene& scene, const ProgramVolume& volume,
                      std::span<const TransferTable> tables, GLuint firstTransferUnit) {
  program.set("volume", static_cast<int>(kVolumeUnit));
  program.set("cellMap", static_cast<int>(kCellMapUnit));
  program.set("laplacianField", static_cast<int>(kLaplacianUnit));
  program.set("labelMasks", static_cast<int>(kLabelUnit));
  const Box box = volume.grid.boxIndex();
  const glm::dvec3 centre = volume.grid.centreIndex();
  program.set("boxLo", toFloat(box.lo - centre));
  program.set("boxHi", toFloat(box.hi - centre));

  program.set("one", 1.0f);
  program.set("clipPlane", centredClipPlanes(scene, volume.grid));

  // Differences of stored values at ±1 voxel → world gradient over gradientUnit().
  program.set("differencesToGradient",
              glm::mat3{glm::transpose(volume.grid.worldToIndex()) *
                        (0.5 * volume.scale.range / gradientUnit(volume.gradients))});

  if (scene.quality.normals == Normals::kQuantised) setDirectionPalette(program);

  std::vector<glm::vec3> lightColours;
  for (const Light& light : scene.lights)
    lightColours.push_back(toFloat(light.colour.linear() * light.intensity));
  program.set("lightColours", lightColours);
  for (std::size_t i = 0; i < tables.size(); ++i)
    setTransferUniforms(program, tables[i], volume.scale, i,
                        firstTransferUnit + kUnitsPerFunction * static_cast<GLuint>(i));
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    setStyleUniforms(program, scene.layers[i], volume.gradients, i);
    program.set(widgetsUniform(i), widgetRows(scene.layers[i].transferFunction, volume.scale));
    setHaloUniforms(program, scene.layers[i], volume, i);
  }
  setSurfaceUniforms(program, scene, volume.scale);
  program.set("cellShift", toFloat(centre - glm::floor(centre)));
}

void setViewUniforms(const GlProgram& program, const Scene& scene, const Camera& camera,
                     const VolumeGrid& grid) {
  const double slope = camera.projection == Projection::kPerspective ? camera.pixelSize : 0.0;
  program.set("imageCentre", glm::vec2{0.5f * static_cast<float>(camera.image.width),
                                       0.5f * static_cast<float>(camera.image.height)});
  program.set("pixelSlope", static_cast<float>(slope));
  program.set("eyeward", toFloat(-camera.forward));
  program.set("eyewardX", toFloat(-slope * camera.right));
  program.set("eyewardY", toFloat(slope * camera.up));
  std::vector<glm::vec3> lights;
  for (const Light& light : scene.lights)
    lights.push_back(toFloat(lightDirectionWorld(light, camera)));
  program.set("lightDirections", lights);
  const glm::dmat3 axes{camera.right, camera.up, -camera.forward};
  program.set("haloFrame", glm::mat3{glm::transpose(axes)});
  program.set("haloAxes", glm::mat3{grid.worldToIndex() * (grid.smallestSpacing() * axes)});
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    for (const StyleSettings& style : scene.layers[i].styles)
      if (findStyle(style.name)->needsPosition)
        program.set(placeUniform(i, style.name), placeOf(style, camera, grid));
}

void setStepUniforms(const GlProgram& program, const Camera& camera, const VolumeGrid& grid,
                     double stepVoxels) {
  const SampleLattice lattice = makeSampleLattice(camera, grid, stepVoxels);
  program.set("exitMargin", static_cast<float>(1e-3 / std::max(stepVoxels, 1.0)));
  program.set("base", toFloat(lattice.base));
  program.set("baseX", toFloat(lattice.baseX));
  program.set("baseY", toFloat(lattice.baseY));
  program.set("along", toFloat(lattice.step));
  program.set("alongX", toFloat(lattice.stepX));
  program.set("alongY", toFloat(lattice.stepY));
  program.set("nearPlane", std::max(static_cast<float>(lattice.nearPlane), -kFar));
  program.set("stepWorld", static_cast<float>(lattice.stepWorld));
}

void setBrickUniforms(const GlProgram& program, const Scene& scene, const VolumeGrid& grid,
                      const Brick& brick) {
  const glm::dvec3 centre = grid.centreIndex();
  const glm::ivec3 cells = grid.cells();
  glm::vec3 lo = toFloat(glm::dvec3{brick.cells().lo} - centre);
  glm::vec3 hi = toFloat(glm::dvec3{brick.cells().hi} - centre);
  for (int axis = 0; axis < 3; ++axis) {
    if (brick.cells().lo[axis] == 0) lo[axis] = -kFar;
    if (brick.cells().hi[axis] == cells[axis]) hi[axis] = kFar;
  }
  program.set("brickLo", lo);
  program.set("brickHi", hi);
  const IndexBox& stored = brick.storedVoxels();
  const glm::dvec3 textureOffset = centre - glm::dvec3{stored.lo} + 0.5;
  program.set("textureOffset", toFloat(textureOffset));
  program.set("texelShift", toFloat(glm::floor(centre) - glm::dvec3{stored.lo}));
  program.set("textureScale", toFloat(1.0 / glm::dvec3{stored.size()}));
  program.set("cellOffset", toFloat(centre - glm::dvec3{brick.mapOrigin()}));
  setCapUniforms(program, scene, grid, stored, textureOffset);
}

void bindTextures(const Brick& brick) {
  gl().BindTextureUnit(kVolumeUnit, brick.volumeTexture());
  gl().BindTextureUnit(kCellMapUnit, brick.mapTexture());
  gl().BindTextureUnit(kLaplacianUnit, brick.laplacianTexture());
  gl().BindTextureUnit(kLabelUnit, brick.labelTexture());
}

}  // namespace burin::node
