// Under every style the error of the march falls with the square of the step. Interpolation adds
// none: a multilinear field and its central differences are what trilinear look-ups say they are,
// and unlike a linear one's its gradients turn along a ray. Only its Laplacian is zero everywhere,
// so that of the style of that name nothing is seen here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "node/reference_fixture.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

constexpr int kPictureSide = 8;
constexpr glm::ivec3 kMultilinearDims{12, 13, 11};

ArraySource multilinearVolume() {
  return {makeGrid(kMultilinearDims), [](glm::ivec3 at) {
            const glm::dvec3 p{at};
            return static_cast<float>(0.1 + 0.02 * p.x + 0.003 * p.y * p.z + 0.002 * p.x * p.y +
                                      0.0015 * p.x * p.z);
          }};
}

/// That style alone. Its curves are straight and its steps wide: a kink between two samples also
/// adds an error of second order, but one that goes up and down with the kink's place in the
/// segment.
Scene smoothSceneWith(const std::string& style, const VolumeGrid& grid) {
  Scene scene = sceneWithStyle(style);
  scene.quality.termination = 0;
  Layer& layer = scene.layers.front();
  layer.transferFunction = {.points = {{0, {255, 0, 0}, 0.05}, {1.25, {0, 255, 255}, 0.4}},
                            .opacityUnitLength = 1.0};
  // Everywhere above the layer's own, as the larger of the two counts.
  if (!layer.lineOpacity.empty()) layer.lineOpacity = {{0, 0.8}, {1.25, 0.95}};
  for (StyleSettings& settings : layer.styles) {
    const StyleSpec& spec = *findStyle(settings.name);
    for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
      const std::string_view name = spec.parameters[i].name;
      ParameterValue& value = settings.values[i];
      if (name == "softness") value = 1.0;
      if (name == "exponent" && settings.name == "specular") value = 4.0;
      if (name == "threshold") value = 0.0;
      if (std::holds_alternative<Curve>(value)) value = Curve{{{0, 0.2}, {1, 1}}};
      if (auto* colours = std::get_if<ColourCurve>(&value))
        colours->points = {{-1, colours->points.front().colour},
                           {1, colours->points.back().colour}};
    }
  }
  // Away from the border, where central differences are one-sided.
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal{0};
    normal[axis] = 1;
    const double first = grid.origin[axis] + 1.5;
    const double last = grid.origin[axis] + kMultilinearDims[axis] - 2.5;
    scene.clip.push_back({.normal = normal, .offset = -first, .hasCap = false});
    scene.clip.push_back({.normal = -normal, .offset = last, .hasCap = false});
  }
  return scene;
}

double rmsDifference(const std::vector<glm::dvec4>& a, const std::vector<glm::dvec4>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(StyleConvergence, IsOfSecondOrderUnderEveryStyle) {
  ArraySource source = multilinearVolume();
  const VolumeGrid& grid = source.info().grid;
  const Camera camera =
      makeCamera(Projection::kPerspective, grid.centreWorld() + glm::dvec3{-20, 14, -6},
                 grid.centreWorld(), 0.06, {kPictureSide, kPictureSide});
  constexpr double kGradientScale = 0.1;  // |∇f| is 0.03 … 0.07
  std::vector<glm::dvec4> plain;
  for (const std::string& style : drawnStyles()) {
    Scene scene = smoothSceneWith(style, grid);
    const auto at = [&](double step) {
      scene.quality.stepVoxels = step;
      return draw(scene, source, camera, kGradientScale);
    };
    // The finest step's own error is a 64th of the one at 1/8: it changes an order over two
    // halvings by log2((1 - 1/1024) / (1 - 1/64)) / 2 = 0.01.
    const auto truth = at(1.0 / 64);
    if (style == "plain") {  // the first one
      plain = truth;
    } else if (style != "laplacian") {
      EXPECT_GT(rmsDifference(truth, plain), 1e-3) << style << " is not seen";
    }
    ASSERT_GT(largestOpacity(truth), 0.2) << style;
    const double coarse = rmsDifference(at(0.5), truth);
    const double fine = rmsDifference(at(0.125), truth);
    const double order = std::log2(coarse / fine) / 2;
    fmt::print("{:12} errors (rms) {:.2e}, {:.2e}, order {:.2f}\n", style, coarse, fine, order);
    EXPECT_GE(order, 1.9) << style;
    EXPECT_GT(fine, 1e-7) << style << ": the orders are those of rounding";
  }
}

}  // namespace
}  // namespace burin::test
