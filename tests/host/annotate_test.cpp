#include "burin/host/annotate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burin/host/text.hpp"

namespace burin::host {
namespace {

struct Shot {
  Scene scene;
  VolumeFacts volume;
  Camera camera;
  Image<Rgba> frame;
  DisplayPicture picture;

  void take() {
    camera = resolveCamera(scene, volume);
    frame = Image<Rgba>{scene.imageSize};
    picture = toDisplay(frame, scene.background);
  }
  std::vector<PixelRectangle> annotated() {
    return annotate(picture, frame, scene, volume, camera);
  }
  bool isPaper(int x, int y) const {
    const auto pixel = picture.bytes.begin() + 3 * (y * picture.size.width + x);
    return std::all_of(pixel, pixel + 3, [](std::uint8_t byte) { return byte == 255; });
  }
};

Shot shot(ImageSize size) {
  Shot made;
  made.scene.imageSize = size;
  Layer layer;
  layer.name = "bone";
  layer.transferFunction.points = {{0, {80, 20, 10}, 0}, {100, {250, 240, 200}, 0.8}};
  layer.transferFunction.opacityUnitLength = 1;
  made.scene.layers = {layer};
  made.volume.grid.dims = {51, 41, 31};
  made.volume.grid.spacing = {1, 1.5, 2};
  made.volume.anatomical = true;
  return made;
}

Annotations everything() {
  Annotations all;
  all.title = "Head, 1:2";
  all.hasOrientation = true;
  all.scaleBar.emplace();
  all.hasLegend = true;
  return all;
}

bool contains(const PixelRectangle& r, int x, int y) {
  return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
}

TEST(Annotate, ChangesOnlyWhatItReports) {
  Shot made = shot({400, 300});
  made.scene.annotations = everything();
  made.take();
  const std::vector<PixelRectangle> places = made.annotated();
  ASSERT_EQ(places.size(), 4u);
  std::vector<int> inked(places.size());
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      if (made.isPaper(x, y)) continue;
      const auto place =
          std::ranges::find_if(places, [&](const PixelRectangle& r) { return contains(r, x, y); });
      ASSERT_NE(place, places.end()) << x << ", " << y;
      ++inked[static_cast<std::size_t>(place - places.begin())];
    }
  }
  for (const int count : inked) EXPECT_GT(count, 30);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(places[i], places[j]));
}

TEST(Annotate, NothingIsAskedForNothingChanges) {
  Shot made = shot({64, 64});
  made.take();
  EXPECT_TRUE(made.annotated().empty());
}

TEST(Annotate, KeepsOutOfTheWay) {
  Shot made = shot({200, 200});
  made.scene.annotations.scaleBar.emplace();
  made.take();
  // All but the upper left quarter is covered.
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      if (x > 100 || y > 100) made.frame.at(x, y) = {0, 0, 0, 1};
  const auto places = made.annotated();
  ASSERT_EQ(places.size(), 1u);
  EXPECT_LT(places[0].x + places[0].width, 101);
  EXPECT_LT(places[0].y + places[0].height, 101);
}

TEST(Annotate, WhatIsLargerThanThePictureIsLeftOut) {
  Shot made = shot({64, 64});
  made.scene.annotations.scaleBar = ScaleBar{1e9, "km"};
  made.take();
  EXPECT_TRUE(made.annotated().empty());
}

/// The longest run of ink in a row.
int longestRun(const Shot& made) {
  int longest = 0;
  for (int y = 0; y < made.picture.size.height; ++y) {
    int run = 0;
    for (int x = 0; x < made.picture.size.width; ++x) {
      run = made.isPaper(x, y) ? 0 : run + 1;
      longest = std::max(longest, run);
    }
  }
  return longest;
}

TEST(ScaleBar, IsAsLongAsTheWorldLengthAtTheTarget) {
  for (const double zoom : {0.7, 1.0, 2.5}) {
    Shot made = shot({500, 400});
    made.scene.camera.zoom = zoom;
    made.scene.camera.verticalFovDeg = 40;
    made.scene.annotations.scaleBar = ScaleBar{23, "mm"};
    made.take();
    made.annotated();
    // The orbit camera is R / sin(fov / 2) away; the smaller side shows 2 tan(fov / 2) / zoom of
    // that.
    const double half = glm::radians(20.0);
    const double radius = glm::length(glm::dvec3{50, 60, 60}) / 2;
    const double shown = 2 * std::tan(half) / zoom * radius / std::sin(half);
    EXPECT_NEAR(longestRun(made), 400 * 23 / shown, 1) << zoom;
  }
}

TEST(ScaleBar, FollowsTheTargetOfAnEye) {
  Shot made = shot({300, 300});
  made.scene.camera.eye = glm::dvec3{25, -200, 30};
  made.scene.camera.target = glm::dvec3{25, 10, 30};  // 210 away
  made.scene.annotations.scaleBar = ScaleBar{20, ""};
  made.take();
  made.annotated();
  EXPECT_NEAR(longestRun(made), 150 / std::tan(glm::radians(15.0)) * 20 / 210, 1);
}

TEST(ScaleBar, OrthographicLengthsAreTheSameEverywhere) {
  Shot made = shot({300, 200});
  made.scene.camera.projection = Projection::kOrthographic;
  made.scene.annotations.scaleBar = ScaleBar{20, ""};
  made.take();
  made.annotated();
  const double radius = glm::length(glm::dvec3{50, 60, 60}) / 2;
  EXPECT_NEAR(longestRun(made), 200 * 20 / (2 * radius), 1);  // 2 R is the smaller side
}

TEST(ScaleBar, ChoosesRoundLengths) {
  EXPECT_DOUBLE_EQ(roundLength(1), 1);
  EXPECT_DOUBLE_EQ(roundLength(19.9), 10);
  EXPECT_DOUBLE_EQ(roundLength(20.1), 20);
  EXPECT_DOUBLE_EQ(roundLength(0.0499), 0.02);
  EXPECT_DOUBLE_EQ(roundLength(7e8), 5e8);
}

TEST(Orientation, AxesPointWhereTheyAreSeen) {
  Shot made = shot({100, 100});
  made.scene.camera.view = "anterior";  // face to face: the patient's left is at the right
  made.take();
  const auto expectNear = [](const glm::dvec2& found, const glm::dvec2& expected) {
    EXPECT_LT(glm::length(found - expected), 1e-12);
  };
  expectNear(directionOnScreen({1, 0, 0}, made.camera), {1, 0});
  expectNear(directionOnScreen({0, 1, 0}, made.camera), {0, 0});
  expectNear(directionOnScreen({0, 0, 1}, made.camera), {0, -1});
  made.scene.camera.view = "superior";
  made.take();
  expectNear(directionOnScreen({0, 0, 1}, made.camera), {0, 0});
}

TEST(Orientation, AgreesWithTheProjectionOfPoints) {
  // A point a little along an axis from the target moves on the screen as the arrow points.
  Shot made = shot({100, 100});
  made.take();
  const Camera& camera = made.camera;
  const auto screen = [&](const glm::dvec3& world) {
    const glm::dvec3 offset = world - camera.eyeWorld;
    const double depth = glm::dot(offset, camera.forward) * camera.pixelSize;
    return glm::dvec2{glm::dot(offset, camera.right), -glm::dot(offset, camera.up)} / depth;
  };
  const glm::dvec3 centre = made.volume.grid.centreWorld();
  const double perUnit = pixelsPerWorldUnit(made.scene, made.volume, camera);
  for (const glm::dvec3& axis : {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    const double step = 1e-4;
    const glm::dvec2 moved = (screen(centre + step * axis) - screen(centre)) / (step * perUnit);
    // The target is at the picture's centre, so perspective is of second order there.
    EXPECT_LT(glm::length(moved - directionOnScreen(axis, camera)), 1e-5);
  }
}

TEST(Orientation, ArrowsAreDrawnThere) {
  Shot made = shot({300, 300});
  made.scene.camera.view = "anterior";
  made.scene.annotations.hasOrientation = true;
  made.take();
  const auto places = made.annotated();
  ASSERT_EQ(places.size(), 1u);
  // The reddest ink is at the right of the marker's centre, the bluest above it.
  glm::dvec2 red{0}, blue{0};
  double redWeight = 0, blueWeight = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) {
      const std::uint8_t* p = made.picture.bytes.data() + 3 * (y * 300 + x);
      const double r = std::max(0, p[0] - std::max(p[1], p[2]));
      const double b = std::max(0, p[2] - std::max(p[0], p[1]));
      red += r * glm::dvec2{x, y};
      blue += b * glm::dvec2{x, y};
      redWeight += r;
      blueWeight += b;
    }
  }
  const glm::dvec2 centre{places[0].x + places[0].width / 2.0,
                          places[0].y + places[0].height / 2.0};
  const glm::dvec2 toRed = red / redWeight - centre, toBlue = blue / blueWeight - centre;
  EXPECT_GT(toRed.x, 5);
  EXPECT_LT(std::abs(toRed.y), 3);
  EXPECT_LT(toBlue.y, -5);
  EXPECT_LT(std::abs(toBlue.x), 3);
}

TEST(Legend, ShowsWidgetsByValueAndGradient) {
  Shot made = shot({400, 300});
  TransferFunction& function = made.scene.layers[0].transferFunction;
  function.points.clear();
  function.widgets = {
      {.value = {0, 100}, .gradient = {0, 0.5}, .colour = {255, 0, 0}, .opacity = 1}};
  made.scene.annotations.hasLegend = true;
  made.take();
  const auto places = made.annotated();
  ASSERT_EQ(places.size(), 1u);
  // Below a line of text, three lines high: the rectangle is in its lower half.
  const int x = places[0].x + places[0].width / 2;
  const int top = places[0].y + textHeight(9);
  EXPECT_TRUE(made.isPaper(x, top + 27 / 4));
  const auto* red = &made.picture.bytes[3 * static_cast<std::size_t>((top + 27 * 3 / 4) * 400 + x)];
  EXPECT_GE(red[0], 254);
  EXPECT_LE(red[1], 1);
}

}  // namespace
}  // namespace burin::host
