#include "group_image.hpp"

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// Pixels as premultiplied colours.
class Classifier {
 public:
  Classifier(const TransferFunction& function, const ValueScale& scale)
      : function_{function}, scale_{scale} {}

  Rgba operator()(const Rgba& pixel) const { return pixel; }
  Rgba operator()(const compositor::LargestValuePixel& pixel) const {
    return compositor::LargestValue::isIdentity(pixel) ? Rgba{} : colourOf(double{pixel.value});
  }
  Rgba operator()(const compositor::WeightedSumPixel& pixel) const {
    return pixel.weight > 0 ? colourOf(double{pixel.sum} / double{pixel.weight}) : Rgba{};
  }

 private:
  Rgba colourOf(double stored) const {
    const ColourAndOpacity at = function_.lookUp(scale_.value(stored));
    const glm::vec3 colour{at.opacity * at.colour};
    return {colour.r, colour.g, colour.b, static_cast<float>(at.opacity)};
  }

  const TransferFunction& function_;
  const ValueScale& scale_;
};

}  // namespace

Image<Rgba> mergeGroups(std::span<const Scene> groups, std::span<const GroupImage> images,
                        const ValueScale& scale) {
  BURIN_CHECK_EQ(groups.size(), images.size());
  Image<Rgba> merged{std::visit([](const auto& image) { return image.size(); }, images.front())};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Classifier classify{groups[i].layers.front().transferFunction, scale};
    std::visit(
        [&](const auto& image) {
          BURIN_CHECK(image.size() == merged.size());
          for (std::size_t p = 0; p < merged.pixels().size(); ++p)
            merged.pixels()[p] = over(classify(image.pixels()[p]), merged.pixels()[p]);
        },
        images[i]);
  }
  return merged;
}

}  // namespace burin::node
