// Slices as hardware with paletted textures drew them: directions quantised at voxels, and palettes
// looked up before filtering.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ranges>
#include <vector>

#include "direction_palette.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

using Directions = std::vector<glm::dvec3>;

const double kGolden = (1 + std::sqrt(5.0)) / 2;

/// (x, y, z) with all signs, turned through the axes, each once.
void addTurned(Directions& all, const glm::dvec3& v) {
  for (int turn = 0; turn < 3; ++turn)
    for (int signs = 0; signs < 8; ++signs) {
      glm::dvec3 w{v[turn], v[(turn + 1) % 3], v[(turn + 2) % 3]};
      for (int axis = 0; axis < 3; ++axis)
        if ((signs >> axis & 1) != 0) w[axis] = -w[axis];
      w = glm::normalize(w);
      if (std::ranges::none_of(all, [&](const auto& u) { return glm::distance(u, w) < 1e-9; }))
        all.push_back(w);
    }
}

/// Centroids of the pentakis dodecahedron's faces, split in 4, from its corners' coordinates alone.
Directions splitPentakisDodecahedron() {
  Directions icosahedron, dodecahedron;
  addTurned(icosahedron, {0, 1, kGolden});
  addTurned(dodecahedron, {1, 1, 1});
  addTurned(dodecahedron, {1 / kGolden, 0, kGolden});
  EXPECT_EQ(icosahedron.size(), 12u);
  EXPECT_EQ(dodecahedron.size(), 20u);
  // Neighbours on the unit sphere: 4 / (sqrt(3) (1 + sqrt(5))) apart on the dodecahedron; the next
  // pairs of either kind are half as far again, at least.
  const double edge = 4 / (std::sqrt(3.0) * 2 * kGolden);
  Directions centroids;
  for (const glm::dvec3& a : icosahedron)
    for (std::size_t i = 0; i < dodecahedron.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const glm::dvec3 &b = dodecahedron[i], &c = dodecahedron[k];
        if (glm::distance(b, c) > 1.1 * edge || glm::distance(a, b) > edge ||
            glm::distance(a, c) > edge)
          continue;
        const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c),
                         ca = glm::normalize(c + a);
        for (const glm::dvec3& sum : {a + ab + ca, b + bc + ab, c + ca + bc, ab + bc + ca})
          centroids.push_back(glm::normalize(sum));
      }
  return centroids;
}

const glm::dvec3& nearest(const Directions& all, const glm::dvec3& v) {
  return *std::ranges::max_element(all, {}, [&](const glm::dvec3& u) { return glm::dot(u, v); });
}

/// `count` unit vectors, evenly over the sphere (golden spiral).
Directions spiral(int count) {
  Directions all;
  for (int i = 0; i < count; ++i) {
    const double z = (2 * i + 1.0) / count - 1;
    const double angle = 2 * std::numbers::pi * i / kGolden;
    const double r = std::sqrt(1 - z * z);
    all.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return all;
}

TEST(DirectionPalette, MirroredMakesTheSplitPentakisDodecahedron) {
  const Directions expected = splitPentakisDodecahedron();
  ASSERT_EQ(expected.size(), 240u);
  const node::DirectionPalette palette = node::directionPalette();
  Directions all{palette.directions.begin(), palette.directions.end()};
  for (std::size_t i = 0; i < all.size() && all.size() <= 240; ++i)
    for (const glm::dvec3& mirror : palette.mirrors) {
      const glm::dvec3 other = all[i] - 2 * glm::dot(mirror, all[i]) * mirror;
      if (glm::distance(nearest(all, other), other) > 1e-9) all.push_back(other);
    }
  EXPECT_EQ(all.size(), 240u);
  for (const glm::dvec3& v : all) EXPECT_LT(glm::distance(nearest(expected, v), v), 1e-12);
}

TEST(DirectionPalette, IsOffByFiveDegreesAndByTwelveAtMost) {
  const Directions all = splitPentakisDodecahedron();
  double sum = 0, largest = 0;
  const Directions everywhere = spiral(100'000);
  for (const glm::dvec3& v : everywhere) {
    const double angle = glm::degrees(std::acos(std::min(glm::dot(nearest(all, v), v), 1.0)));
    sum += angle;
    largest = std::max(largest, angle);
  }
  // As computed from a million random directions, too; points of the spiral are 0.6 degrees apart.
  EXPECT_NEAR(sum / 100'000, 5.286, 0.005);
  EXPECT_GT(largest, 11.2);
  EXPECT_LT(largest, 11.47);
}

/// Seen along an axis in parallel, without termination.
Scene slicedScene(const std::string& style) {
  Scene scene = sceneWithStyle(style);
  scene.imageSize = {8, 8};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene.quality = {.stepVoxels = 0.25, .termination = 0, .preintegrated = false};
  return scene;
}

Image<Rgba> drawSlices(const Scene& scene, node::BrickSource& source,
                       node::WorkerOptions options = {}) {
  options.technique = node::Technique::kSlices;
  const Scene ready = resolved(scene, source);
  return drawAlone(ready, source, resolveCamera(ready, {source.info().grid, false}), options);
}

// In a volume that rises evenly along a direction, its normal is shown as a colour: what the
// program makes of it is the nearest of all 240, whatever the direction.
TEST(Palettes, GradientsPointInTheNearestDirection) {
  const Directions all = splitPentakisDodecahedron();
  const VolumeGrid grid = gridOf({8, 8, 8});
  // The spiral's first direction lies in a mirror, where two of all are as near and rounding
  // chooses one for each voxel: what lies between these two is right there.
  for (const glm::dvec3& rise : spiral(12) | std::views::drop(1)) {
    ArraySource source{
        grid, [&](glm::ivec3 i) {
          return static_cast<float>(0.5 + 0.07 * glm::dot(rise, glm::dvec3{i} - 3.5));
        }};
    Scene scene = slicedScene("light");
    scene.layers[0].styles[0].values[2] = 1.0;  // normal_color
    scene.layers[0].transferFunction = {{{0, {9, 9, 9}, 0.5}, {1, {9, 9, 9}, 0.5}}, {}};
    scene.clipBox = ClipBox{grid.centreWorld() - 1.0, grid.centreWorld() + 1.0, false};
    scene.quality.normals = Normals::kQuantised;
    const glm::dvec3 outward = nearest(all, -rise);
    for (const Palettes palettes : {Palettes::kAfter, Palettes::kBefore}) {
      scene.quality.palettes = palettes;
      const Image<Rgba> image = drawSlices(scene, source);
      const Rgba& pixel = image.at(4, 4);
      ASSERT_GT(pixel.a, 0.5);
      const glm::dvec3 normal = 2.0 * glm::dvec3{pixel.r, pixel.g, pixel.b} / double{pixel.a} - 1.0;
      SCOPED_TRACE(testing::Message() << rise.x << " " << rise.y << " " << rise.z);
      // The others are 0.1 away and more; 16 samples round a few times each. Between two of them
      // that are as near either is right.
      EXPECT_LT(glm::distance(normal, nearest(all, normal)), 1e-4);
      EXPECT_GT(glm::dot(normal, -rise), glm::dot(outward, -rise) - 1e-4);
    }
  }
}

/// A volume that changes along z alone, and what its voxels look like by palettes.
struct Column {
  std::vector<double> values;
  TransferFunction function;
  Curve surface{{{0, 0.2}, {1, 1.5}}};
  double ambient = 0.2, diffuse = 0.7, noiseFloor = 0.1;

  double value(int k) const {
    return values[static_cast<std::size_t>(std::clamp(k, 0, static_cast<int>(values.size()) - 1))];
  }
  double slope(int k) const { return (value(k + 1) - value(k - 1)) / 2; }
  double steepest() const {
    double most = 0;
    for (int k = 0; k < static_cast<int>(values.size()); ++k)
      most = std::max(most, std::abs(slope(k)));
    return most;
  }

  struct Entry {
    glm::dvec3 colour;
    double extinction, factor, light;
    Entry operator*(double share) const {
      return {share * colour, share * extinction, share * factor, share * light};
    }
    Entry operator+(const Entry& o) const {
      return {colour + o.colour, extinction + o.extinction, factor + o.factor, light + o.light};
    }
  };
  /// Of a voxel, lit from the eye, which is at large z.
  Entry entry(int k) const {
    const Classified plain = function.classify(value(k), 1);
    const double m = std::abs(slope(k)) / steepest();
    const double t = std::clamp(m / noiseFloor - 1, 0.0, 1.0);
    const double confidence = t * t * (3 - 2 * t);
    const double facing = slope(k) < 0 ? 1 : 0;  // outward is where values fall
    const double shade = ambient + diffuse * facing;
    return {plain.colour, plain.extinction, surface.at(m), 1 + confidence * (shade - 1)};
  }
  Entry filtered(double z) const {
    const int k = std::min(static_cast<int>(z), static_cast<int>(values.size()) - 2);
    return entry(k) * (1 - (z - k)) + entry(k + 1) * (z - k);
  }
};

// Transfer function, light and surface of voxels, each filtered by itself, then multiplied. Where
// the values themselves are filtered first, a spike between two voxels shows; here it does not.
TEST(Palettes, BeforeFilteringAreFilteredAndThenMultiplied) {
  Column column{{0.1, 0.9, 0.9, 0.2, 0.5, 0.1, 0.8, 0.6},
                {{{0, {10, 200, 90}, 0.02},
                  {0.3, {250, 40, 30}, 0.1},
                  {0.35, {20, 20, 250}, 0.9},
                  {0.4, {250, 250, 20}, 0.1},
                  {1, {240, 240, 240}, 0.2}},
                 1.0}};
  ArraySource source{gridOf({5, 5, 8}),
                     [&](glm::ivec3 i) { return static_cast<float>(column.value(i.z)); }};
  Scene scene = slicedScene("surface");
  Layer& layer = scene.layers[0];
  StyleSettings gradient = defaultSettings(*findStyle("gradient"));
  gradient.values[1] = column.noiseFloor;
  gradient.values[3] = std::string{"maximum"};
  layer.styles[0].values[0] = column.surface;
  StyleSettings light = defaultSettings(*findStyle("light"));
  light.values[0] = column.ambient;
  light.values[1] = column.diffuse;
  layer.styles = {gradient, layer.styles[0], light};
  layer.transferFunction = column.function;
  scene.lights = {{.direction = {0, 0, 1}}};
  scene.quality.stepVoxels = 0.125;  // the spike is as thin
  scene.quality.palettes = Palettes::kBefore;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});

  // The lattice's segments within the volume, from the eye on.
  const double eye = camera.eyeWorld.z;
  const double step = scene.quality.stepVoxels;
  glm::dvec3 colour{0};
  double opacity = 0;
  for (double depth = eye - 7; depth < eye;) {
    const double next = std::min((std::floor(depth / step + 1e-9) + 1) * step, eye);
    const Column::Entry sample = column.filtered(eye - (depth + next) / 2);
    const double alpha = -std::expm1(-sample.extinction * sample.factor * (next - depth));
    colour += (1 - opacity) * alpha * sample.light * sample.colour;
    opacity += (1 - opacity) * alpha;
    depth = next;
  }
  const Image<Rgba> before = drawSlices(scene, source);
  const Rgba& pixel = before.at(4, 4);
  // 57 samples of some ten roundings each, of numbers up to 1, and the table's colours in floats.
  EXPECT_NEAR(pixel.r, colour.r, 2e-5);
  EXPECT_NEAR(pixel.g, colour.g, 2e-5);
  EXPECT_NEAR(pixel.b, colour.b, 2e-5);
  EXPECT_NEAR(pixel.a, opacity, 2e-5);
  scene.quality.palettes = Palettes::kAfter;
  EXPECT_GT(difference(drawSlices(scene, source), before).largest, 0.05);
}

struct Historic {
  Normals normals;
  Palettes palettes;
};

// What is quantised or classified is so at voxels, where all bricks have the same numbers.
TEST(Palettes, AnyBricksAndSkippingDrawTheSamePicture) {
  ArraySource source = smoothVolume(gridOf({26, 22, 24}, {1, 1.2, 0.8}));
  Scene scene = sceneWithStyle("surface");
  for (const char* style : {"tone", "edges"})
    scene.layers[0].styles.push_back(defaultSettings(*findStyle(style)));
  scene.imageSize = {36, 28};
  scene.camera = {.azimuthDeg = 35, .elevationDeg = 25};
  scene.clip = {{{1, 0.3, 0.2}, -6}};
  scene.quality = {.stepVoxels = 1, .termination = 0, .preintegrated = false};
  scene.layers[0].transferFunction.points = {
      {0.5, {90, 180, 250}, 0}, {0.6, {250, 180, 90}, 0.4}, {0.7, {9, 250, 20}, 0}};
  const Image<Rgba> exact = drawSlices(scene, source);
  for (const Historic& way : {Historic{Normals::kQuantised, Palettes::kAfter},
                              Historic{Normals::kExact, Palettes::kBefore},
                              Historic{Normals::kQuantised, Palettes::kBefore}}) {
    scene.quality.normals = way.normals;
    scene.quality.palettes = way.palettes;
    const Image<Rgba> one = drawSlices(scene, source);
    EXPECT_GT(largestAlpha(one), 0.3);
    EXPECT_GT(difference(one, exact).largest, 0.01);
    // Bounds of brick_invariance_test.cpp.
    const Difference d = difference(one, drawSlices(scene, source, {.bricks = 7}));
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.largest, 5e-5);
    EXPECT_LE(d.rms, 2e-6);
    const Image<Rgba> visited = drawSlices(scene, source, {.skip = false});
    EXPECT_TRUE(std::ranges::equal(one.pixels(), visited.pixels()));
  }
}

}  // namespace
}  // namespace burin::test
