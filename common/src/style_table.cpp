#include "burin/common/style.hpp"

namespace burin {

namespace {

using namespace std::string_literals;

StyleSpec gradientStyle() {
  return {.name = "gradient",
          .help = "how the layer's gradients become directions (settings of the styles below)",
          .ghostLayers = 1,
          .hasSnippet = false,
          .parameters = {
              {.name = "noise_floor",
               .help = "gradient magnitude below which there is no direction",
               .defaultValue = 0.02,
               .minimum = 0.0001,
               .maximum = 0.5,
               .unit = "of the volume's magnitude"},
              {.name = "normal",
               .help = "where normals point: away from dense material, into it, or to the eye",
               .defaultValue = "outward"s,
               .choices = {"outward", "inward", "facing"}},
              {.name = "magnitude",
               .help = "the volume's magnitude: 99.9th percentile or maximum over all voxels",
               .defaultValue = "percentile"s,
               .choices = {"percentile", "maximum"}},
          }};
}

StyleSpec surfaceStyle() {
  return {.name = "surface",
          .help = "opacity by gradient magnitude: keeps boundaries, drops homogeneous material",
          .needsGradient = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "opacity",
               .help = "factor on extinction over gradient magnitude 0 … 1",
               .defaultValue = Curve{{{0.02, 0}, {0.25, 1}}},
               .minimum = 0,
               .maximum = 4},
          }};
}

StyleSpec lightStyle() {
  return {.name = "light",
          .help = "Phong's ambient and diffuse light",
          .needsGradient = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "ambient",
               .help = "light from everywhere",
               .defaultValue = 0.3,
               .minimum = 0,
               .maximum = 2},
              {.name = "diffuse",
               .help = "light by the angle to each light",
               .defaultValue = 0.7,
               .minimum = 0,
               .maximum = 2},
              {.name = "normal_color",
               .help = "how much of the normal, as RGB, is mixed in",
               .defaultValue = 0.0,
               .minimum = 0,
               .maximum = 1},
          }};
}

StyleSpec toneStyle() {
  const auto share = [](std::string_view name, std::string_view help, double value) {
    return ParameterSpec{
        .name = name, .help = help, .defaultValue = value, .minimum = 0, .maximum = 1};
  };
  return {.name = "tone",
          .help = "warm where lit, cool where not",
          .needsGradient = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "mode",
               .help = "a colour map over the angle to the first light, or Gooch's shading",
               .defaultValue = "map"s,
               .choices = {"map", "gooch"}},
              share("strength", "how much of the tone is mixed in", 1),
              {.name = "warm",
               .help = "map: factor on colour where lit",
               .defaultValue = Colour{0xff, 0xdc, 0xa8}},
              {.name = "cool",
               .help = "map: factor on colour where turned away",
               .defaultValue = Colour{0x70, 0x88, 0xc8}},
              {.name = "transition",
               .help = "map: half width of the change; small is toon-like",
               .defaultValue = 1.0,
               .minimum = 0.01,
               .maximum = 1,
               .unit = "of the cosine"},
              share("yellow", "gooch: yellow in the warm tone", 0.4),
              share("blue", "gooch: blue in the cool tone", 0.4),
              share("alpha", "gooch: the colour's own share of the cool tone", 0.2),
              share("beta", "gooch: the colour's own share of the warm tone", 0.6),
          }};
}

StyleSpec edgesStyle() {
  return {.name = "edges",
          .help = "lines where a surface turns away from the eye",
          .needsGradient = true,
          .drawsLines = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "strength",
               .help = "opacity of the lines",
               .defaultValue = 1.0,
               .minimum = 0,
               .maximum = 1},
              {.name = "threshold",
               .help = "edge measure below which there is no line",
               .defaultValue = 0.5,
               .minimum = 0,
               .maximum = 0.99},
              {.name = "power",
               .help = "exponent of the edge measure; large is thin",
               .defaultValue = 1.0,
               .minimum = 0.1,
               .maximum = 8},
              {.name = "color", .help = "colour of the lines", .defaultValue = Colour{0, 0, 0}},
          }};
}

StyleSpec specularStyle() {
  return {.name = "specular",
          .help = "highlights in the lights' colours",
          .needsGradient = true,
          .drawsLines = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "strength",
               .help = "opacity of the highlights",
               .defaultValue = 0.5,
               .minimum = 0,
               .maximum = 1},
              {.name = "exponent",
               .help = "shininess; large is small and sharp",
               .defaultValue = 32.0,
               .minimum = 1,
               .maximum = 200},
          }};
}

}  // namespace

std::span<const StyleSpec> styleTable() {
  static const std::vector<StyleSpec> table{gradientStyle(), surfaceStyle(), lightStyle(),
                                            toneStyle(),     edgesStyle(),   specularStyle()};
  return table;
}

}  // namespace burin
