#include "burin/common/style.hpp"

namespace burin {

namespace {

using namespace std::string_literals;

/// A plain number.
ParameterSpec number(std::string_view name, std::string_view help, double value, double minimum,
                     double maximum) {
  return {
      .name = name, .help = help, .defaultValue = value, .minimum = minimum, .maximum = maximum};
}

/// The position that a style with needsPosition depends on; its own parameters follow.
std::vector<ParameterSpec> withPosition(std::vector<ParameterSpec> parameters) {
  std::vector<ParameterSpec> all{
      {.name = "along",
       .help = "position 0 … 1: depth in the view through the bounding sphere, or along the axis",
       .defaultValue = "view"s,
       .choices = {"view", "axis"}},
      {.name = "axis",
       .help = "axis: world direction, 0 at the box's end it comes from, 1 at the other",
       .defaultValue = glm::dvec3{0, 0, 1}},
  };
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

StyleSpec gradientStyle() {
  return {.name = "gradient",
          .help = "how the layer's gradients become directions (settings of the styles below)",
          .ghostLayers = 1,
          .hasSnippet = false,
          .parameters = {
              {.name = "operator",
               .help = "differences of six neighbours, or smoothed over 3x3x3 voxels: less speckle",
               .defaultValue = "central"s,
               .choices = {"central", "sobel", "regression"}},
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

StyleSpec boundaryStyle() {
  return {.name = "boundary",
          .help = "extinction times constant + scale * magnitude ^ exponent: enhances boundaries",
          .needsGradient = true,
          .ghostLayers = 1,
          .parameters = {
              number("constant", "factor on extinction where nothing changes", 0.1, 0, 4),
              number("scale", "what the largest gradient magnitude adds to it", 2, 0, 20),
              number("exponent", "of the gradient magnitude; large keeps only the strongest", 1.5,
                     0.1, 8),
          }};
}

StyleSpec silhouetteStyle() {
  return {.name = "silhouette",
          .help = "extinction times constant + scale * edge measure ^ exponent: denser outlines",
          .needsGradient = true,
          .ghostLayers = 1,
          .parameters = {
              number("constant", "factor on extinction where a surface faces the eye", 0.01, 0, 4),
              number("scale", "what a surface seen sideways adds to it", 1, 0, 20),
              number("exponent", "of the edge measure; large is thin", 4, 0.1, 8),
          }};
}

StyleSpec fadeStyle() {
  return {.name = "fade",
          .help = "opacity of colour and lines by position",
          .needsPosition = true,
          .passes = StylePasses::kBoth,
          .parameters = withPosition({
              {.name = "opacity",
               .help = "factor on extinction and on lines over the position",
               .defaultValue = Curve{{{0.2, 0}, {0.6, 1}}}},
          })};
}

StyleSpec lightStyle() {
  return {.name = "light",
          .help = "Phong's ambient and diffuse light",
          .needsGradient = true,
          .seesCuts = true,
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
          .seesCuts = true,
          .ghostLayers = 1,
          .parameters = {
              {.name = "mode",
               .help = "map: two colours by the angle to the first light; colors: a curve of them; "
                       "Gooch's shading; Ebert and Rheingans' shading by all lights",
               .defaultValue = "map"s,
               .choices = {"map", "colors", "gooch", "ebert"}},
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
              {.name = "colors",
               .help = "colors: factor on colour over the cosine to the light, -1 … 1",
               .defaultValue = ColourCurve{{{-1, {0x3a, 0x50, 0x9e}},
                                            {0, {0xa8, 0xa4, 0xb8}},
                                            {1, {0xff, 0xe0, 0xb0}}}}},
              share("yellow", "gooch, ebert: yellow in the warm tone", 0.4),
              share("blue", "gooch, ebert: blue in the cool tone", 0.4),
              share("alpha", "gooch, ebert: the colour's own share of the cool tone", 0.2),
              share("beta", "gooch, ebert: the colour's own share of the warm tone", 0.6),
              share("ambient", "ebert: light from everywhere", 0.05),
              share("diffuse", "ebert: light by the angle to each light", 0.1),
          }};
}

StyleSpec toonStyle() {
  return {.name = "toon",
          .help = "a few flat tones, the colour itself the darkest, white the lightest",
          .needsGradient = true,
          .seesCuts = true,
          .ghostLayers = 1,
          .parameters = {
              number("tones", "how many tones", 4, 2, 16),
              number("strength", "how much of the tones is mixed in", 1, 0, 1),
              {.name = "softness",
               .help = "width of the change between two tones",
               .defaultValue = 0.1,
               .minimum = 0.01,
               .maximum = 1,
               .unit = "of a tone"},
          }};
}

StyleSpec depthStyle() {
  return {.name = "depth",
          .help = "colour by position: warm and full near, cool and pale far",
          .needsPosition = true,
          .parameters = withPosition({
              {.name = "mode",
               .help = "curves of a factor and a blend, or distance colouring: a blend of "
                       "strength * position ^ exponent",
               .defaultValue = "curves"s,
               .choices = {"curves", "distance"}},
              {.name = "factor",
               .help = "curves: factor on colour over the position",
               .defaultValue = ColourCurve{{{0.2, {0xff, 0xf0, 0xdc}}, {0.8, {0xc8, 0xd8, 0xf0}}}}},
              {.name = "blend",
               .help = "curves: share of the blend's colour over the position",
               .defaultValue = Curve{{{0.3, 0}, {0.9, 0.7}}}},
              {.name = "color",
               .help = "colour that is blended in",
               .defaultValue = Colour{0xb4, 0xc8, 0xe0}},
              number("strength", "distance: share of that colour at the far end", 0.8, 0, 1),
              number("exponent", "distance: of the position; large begins late", 1.5, 0.1, 8),
          })};
}

StyleSpec laplacianStyle() {
  const auto threshold = [](std::string_view name, std::string_view help, double value) {
    return ParameterSpec{.name = name,
                         .help = help,
                         .defaultValue = value,
                         .minimum = 0,
                         .maximum = 1,
                         .unit = "of the volume's magnitude"};
  };
  return {
      .name = "laplacian",
      .help = "creases: darkens where the smoothed second derivative is large",
      .needsLaplacian = true,
      .ghostLayers = 3,
      .parameters = {
          threshold("above", "Laplacian above which colour changes: hollows of dense material",
                    0.05),
          threshold("below", "the same of a negative one: crests and thin walls; 1 is never", 1),
          {.name = "softness",
           .help = "from a threshold on, over how much of the Laplacian the change spreads",
           .defaultValue = 0.1,
           .minimum = 0.01,
           .maximum = 1},
          {.name = "strength",
           .help = "how much of the colour is mixed in",
           .defaultValue = 0.8,
           .minimum = 0,
           .maximum = 1},
          {.name = "color", .help = "what it changes to", .defaultValue = Colour{0, 0, 0}},
      }};
}

StyleSpec haloStyle() {
  return {.name = "halo",
          .help = "dark rims just outside what the layer shows, hiding what lies behind",
          .needsGradient = true,
          .ghostLayers = 3,  // at its default radius: ghostLayersNeeded()
          .parameters = {
              {.name = "radius",
               .help = "how far outside",
               .defaultValue = 2.0,
               .minimum = 1,
               .maximum = 8,
               .unit = "smallest voxel spacings"},
              number("strength", "extinction of a full halo, per opacity unit length", 3, 0, 20),
              number("direction_power", "of the cosine between outline and halo; large is thin", 2,
                     1, 8),
              number("edge_power", "of the edge measure; large is at outlines alone", 2, 1, 8),
              {.name = "color", .help = "colour of the halo", .defaultValue = Colour{0, 0, 0}},
          }};
}

StyleSpec edgesStyle() {
  return {.name = "edges",
          .help = "lines where a surface turns away from the eye",
          .needsGradient = true,
          .passes = StylePasses::kLines,
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
          .passes = StylePasses::kLines,
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

StyleSpec lineSurfaceStyle() {
  return {.name = "line_surface",
          .help = "lines by gradient magnitude: only at strong surfaces",
          .needsGradient = true,
          .passes = StylePasses::kLines,
          .ghostLayers = 1,
          .parameters = {
              {.name = "opacity",
               .help = "factor on the amount of lines over gradient magnitude 0 … 1",
               .defaultValue = Curve{{{0.1, 0}, {0.3, 1}}}},
          }};
}

}  // namespace

std::span<const StyleSpec> styleTable() {
  static const std::vector<StyleSpec> table{
      gradientStyle(), surfaceStyle(), boundaryStyle(), silhouetteStyle(), fadeStyle(),
      lightStyle(),    toneStyle(),    toonStyle(),     depthStyle(),      laplacianStyle(),
      haloStyle(),     edgesStyle(),   specularStyle(), lineSurfaceStyle()};
  return table;
}

}  // namespace burin
