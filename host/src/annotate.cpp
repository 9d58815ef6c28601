#include "burin/host/annotate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "burin/common/error.hpp"
#include "insets.hpp"

namespace burin::host {

namespace {

/// Where in a picture something may stand: 0 left or top, 1 the middle, 2 right or bottom.
struct Anchor {
  int x;
  int y;
};
using Anchors = std::vector<Anchor>;  ///< the best liked one first

const Anchors kAtTheTop{{1, 0}, {0, 0}, {2, 0}, {1, 2}};
const Anchors kBelow{{2, 2}, {0, 2}, {1, 2}, {2, 0}, {0, 0}, {1, 0}};
const Anchors kAtTheLeft{{0, 2}, {2, 2}, {0, 0}, {2, 0}, {0, 1}, {2, 1}};
const Anchors kAtTheRight{{2, 1}, {0, 1}, {2, 0}, {0, 0}, {2, 2}, {0, 2}};

int placed(int anchor, int picture, int inset, int margin) {
  if (anchor == 0) return margin;
  if (anchor == 1) return (picture - inset) / 2;
  return picture - inset - margin;
}

/// Lays insets over a picture.
class Layout {
 public:
  Layout(DisplayPicture& picture, ImageView<const Rgba> frame, int margin)
      : picture_{picture}, frame_{frame}, margin_{margin} {}

  void add(const DisplayPicture& inset, const Anchors& anchors) {
    std::optional<PixelRectangle> best;
    double leastCovered = 0;
    for (const Anchor& anchor : anchors) {
      const PixelRectangle place{placed(anchor.x, picture_.size.width, inset.size.width, margin_),
                                 placed(anchor.y, picture_.size.height, inset.size.height, margin_),
                                 inset.size.width, inset.size.height};
      if (!isFree(place)) continue;
      const double covered = coverage(place);
      if (best && covered >= leastCovered) continue;
      best = place;
      leastCovered = covered;
    }
    if (!best) return;
    lay(inset, best->x, best->y);
    taken_.push_back(*best);
  }

  const std::vector<PixelRectangle>& taken() const { return taken_; }

 private:
  bool isFree(const PixelRectangle& place) const {
    const bool fits = place.x >= 0 && place.y >= 0 &&
                      place.x + place.width <= picture_.size.width &&
                      place.y + place.height <= picture_.size.height;
    return fits && std::ranges::none_of(
                       taken_, [&](const PixelRectangle& other) { return overlap(place, other); });
  }

  /// Opacity of what the frame shows there, summed over the pixels.
  double coverage(const PixelRectangle& place) const {
    double sum = 0;
    for (int y = place.y; y < place.y + place.height; ++y)
      for (int x = place.x; x < place.x + place.width; ++x) sum += double{frame_.at(x, y).a};
    return sum;
  }

  void lay(const DisplayPicture& inset, int x, int y) {
    InkMask dot{1, 1};
    const std::uint8_t* pixel = inset.bytes.data();
    for (int row = 0; row < inset.size.height; ++row) {
      for (int column = 0; column < inset.size.width; ++column, pixel += 4) {
        dot.at(0, 0) = pixel[3];
        drawInk(picture_, dot, x + column, y + row, {pixel[0], pixel[1], pixel[2]});
      }
    }
  }

  DisplayPicture& picture_;
  ImageView<const Rgba> frame_;
  int margin_;
  std::vector<PixelRectangle> taken_;
};

Colour inkFor(const Scene& scene) {
  if (scene.annotations.colour) return *scene.annotations.colour;
  const glm::dvec3 back = scene.background.value_or(Colour{255, 255, 255}).linear();
  const double luminance = glm::dot(back, glm::dvec3{0.2126, 0.7152, 0.0722});
  constexpr double kMiddle = 0.18;  // linear light of a middle grey
  return luminance > kMiddle ? Colour{32, 32, 32} : Colour{240, 240, 240};
}

int fontSizeFor(const Scene& scene) {
  if (scene.annotations.fontSize > 0) return scene.annotations.fontSize;
  return std::clamp(std::min(scene.imageSize.width, scene.imageSize.height) / 36, 9, 60);
}

glm::dvec3 targetWorld(const Scene& scene, const VolumeFacts& volume) {
  return scene.camera.target.value_or(volume.grid.centreWorld());
}

DisplayPicture scaleBar(const Scene& scene, const VolumeFacts& volume, const Camera& camera,
                        int fontSize, const Colour& ink) {
  constexpr double kShare = 0.2;  // of the picture's width
  const ScaleBar& bar = *scene.annotations.scaleBar;
  const double pixels = pixelsPerWorldUnit(scene, volume, camera);
  const double length = bar.length.value_or(roundLength(kShare * camera.image.width / pixels));
  const std::string unit = bar.unit.value_or(volume.anatomical ? "mm" : "");
  // One that is longer than any picture fits nowhere, however much longer it is.
  return scaleBarInset(std::min(length * pixels, kLargestImageSide + 1.0),
                       fmt::format("{:g}{}{}", length, unit.empty() ? "" : " ", unit), fontSize,
                       ink);
}

}  // namespace

double pixelsPerWorldUnit(const Scene& scene, const VolumeFacts& volume, const Camera& camera) {
  if (camera.projection == Projection::kOrthographic) return 1 / camera.pixelSize;
  const glm::dvec3 target = targetWorld(scene, volume);
  return 1 / (camera.pixelSize * std::abs(glm::dot(target - camera.eyeWorld, camera.forward)));
}

glm::dvec2 directionOnScreen(const glm::dvec3& world, const Camera& camera) {
  return {glm::dot(world, camera.right), -glm::dot(world, camera.up)};
}

double roundLength(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

std::vector<PixelRectangle> annotate(DisplayPicture& picture, ImageView<const Rgba> frame,
                                     const Scene& scene, const VolumeFacts& volume,
                                     const Camera& camera) {
  const Annotations& wanted = scene.annotations;
  const int fontSize = fontSizeFor(scene);
  const Colour ink = inkFor(scene);
  Layout layout{picture, frame, fontSize};
  if (wanted.title) layout.add(titleInset(*wanted.title, fontSize * 3 / 2, ink), kAtTheTop);
  if (wanted.scaleBar) layout.add(scaleBar(scene, volume, camera, fontSize, ink), kBelow);
  if (wanted.hasOrientation)
    layout.add(orientationInset(camera, volume.anatomical, fontSize, ink), kAtTheLeft);
  if (wanted.hasLegend) layout.add(legendInset(scene.layers, fontSize, ink), kAtTheRight);
  return layout.taken();
}

}  // namespace burin::host
