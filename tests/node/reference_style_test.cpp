// Every style against its formula, worked out by hand for one gradient, view and set of lights.
#include <gtest/gtest.h>

#include "node/reference_ramp.hpp"

namespace burin::test {
namespace {

double smooth(double from, double to, double x) {
  const double t = std::min(std::max((x - from) / (to - from), 0.0), 1.0);
  return 3 * t * t - 2 * t * t * t;
}

/// The probe's facts: slope (1,2,0), hence outward normal -(1,2,0)/√5, magnitude √5 of scale 4.
const RampProbe kProbe;
const glm::dvec3 kNormal = glm::dvec3{-1, -2, 0} / std::sqrt(5.0);
const glm::dvec3 kToEye = glm::dvec3{3, 2, 9} / std::sqrt(94.0);
const glm::dvec3 kLight0 = glm::dvec3{-1, -2, 2} / 3.0;
const glm::dvec3 kLight1 = glm::dvec3{0, -3, 1} / std::sqrt(10.0);
const double kCosine0 = 5 / (3 * std::sqrt(5.0));
const double kCosine1 = 6 / std::sqrt(50.0);
const double kMagnitude = std::sqrt(5.0) / 4;

glm::dvec3 radiance(std::size_t light) {
  return kProbe.lights[light].colour.linear() * kProbe.lights[light].intensity;
}

/// Confidence of this is smoothstep(0.4, 0.8, √5/4), about 0.34: a mixture of both of its ends.
const StyleSettings kHalfSure = makeStyle("gradient", {{"noise_floor", 0.4}});
const double kHalfConfidence = smooth(0.4, 0.8, kMagnitude);

TEST(ReferenceStyle, NoneLeavesTheTransferFunction) {
  const Classified sample = kProbe.measure({});
  expectNear(sample.colour, kProbe.colour());
  EXPECT_EQ(sample.extinction, 1);
}

TEST(ReferenceStyle, Light) {
  const auto light = makeStyle("light", {{"ambient", 0.2}, {"diffuse", 0.6}});
  const glm::dvec3 shade = 0.2 + 0.6 * (kCosine0 * radiance(0) + kCosine1 * radiance(1));
  const Classified sample = kProbe.measure({light});
  expectNear(sample.colour, kProbe.colour() * shade);
  EXPECT_NEAR(sample.extinction, 1, kProbeRounding);
  expectNear(kProbe.measure({kHalfSure, light}).colour,
             kProbe.colour() * (1 - kHalfConfidence + kHalfConfidence * shade));
}

TEST(ReferenceStyle, LightBehindTheSurfaceAddsNothing) {
  RampProbe probe;
  for (Light& light : probe.lights) light.direction = -light.direction;
  expectNear(probe.measure({makeStyle("light", {{"ambient", 0.2}})}).colour, 0.2 * probe.colour());
}

TEST(ReferenceStyle, LightInEyeSpaceTurnsWithTheCamera) {
  RampProbe probe;
  probe.slopeIndex = {-3, -2, -9};  // outward normal towards the eye
  probe.lights = {{.direction = {0, 0, 2}, .eyeSpace = true}};
  const auto light = makeStyle("light", {{"ambient", 0.0}, {"diffuse", 1.0}});
  expectNear(probe.measure({light}).colour, probe.colour());
  probe.lights[0].direction = {1, 0, 1};
  expectNear(probe.measure({light}).colour, probe.colour() / std::sqrt(2.0));
}

TEST(ReferenceStyle, NormalColour) {
  const auto light =
      makeStyle("light", {{"ambient", 1.0}, {"diffuse", 0.0}, {"normal_color", 0.7}});
  const glm::dvec3 direction = 0.5 * kNormal + 0.5;
  expectNear(kProbe.measure({light}).colour, 0.3 * kProbe.colour() + 0.7 * direction);
  const double share = 0.7 * kHalfConfidence;
  expectNear(kProbe.measure({kHalfSure, light}).colour,
             (1 - share) * kProbe.colour() + share * direction);
}

TEST(ReferenceStyle, ToneMap) {
  const Colour warm{255, 200, 100};
  const Colour cool{60, 90, 220};
  // n·l0 is 0.745, within the wide transition and beyond the narrow one.
  for (const double transition : {1.0, 0.5}) {
    const auto tone = makeStyle(
        "tone", {{"transition", transition}, {"strength", 0.8}, {"warm", warm}, {"cool", cool}});
    const double t = smooth(-transition, transition, kCosine0);
    const glm::dvec3 map = (1 - t) * cool.linear() + t * warm.linear();
    expectNear(kProbe.measure({tone}).colour, kProbe.colour() * (0.2 + 0.8 * map));
    const double share = 0.8 * kHalfConfidence;
    expectNear(kProbe.measure({kHalfSure, tone}).colour,
               kProbe.colour() * (1 - share + share * map));
  }
}

TEST(ReferenceStyle, ToneGooch) {
  const auto tone = makeStyle("tone", {{"mode", std::string{"gooch"}},
                                       {"strength", 0.9},
                                       {"yellow", 0.3},
                                       {"blue", 0.5},
                                       {"alpha", 0.1},
                                       {"beta", 0.7}});
  const glm::dvec3 c = kProbe.colour();
  const glm::dvec3 warm{0.3 + 0.7 * c.r, 0.3 + 0.7 * c.g, 0.7 * c.b};
  const glm::dvec3 cool{0.1 * c.r, 0.1 * c.g, 0.5 + 0.1 * c.b};
  const glm::dvec3 toned = warm * (1 + kCosine0) / 2.0 + cool * (1 - kCosine0) / 2.0;
  expectNear(kProbe.measure({tone}).colour, 0.1 * c + 0.9 * toned);
}

TEST(ReferenceStyle, ToneOfAnyColours) {
  const ColourCurve colours{{{-1, {0, 0, 90}}, {0.5, {80, 10, 30}}, {0.9, {255, 200, 10}}}};
  const auto tone =
      makeStyle("tone", {{"mode", std::string{"colors"}}, {"strength", 0.7}, {"colors", colours}});
  const double t = (kCosine0 - 0.5) / 0.4;
  const glm::dvec3 map = (1 - t) * Colour{80, 10, 30}.linear() + t * Colour{255, 200, 10}.linear();
  expectNear(kProbe.measure({tone}).colour, kProbe.colour() * (0.3 + 0.7 * map));
}

TEST(ReferenceStyle, ToneOfEbertAndRheingans) {
  const auto tone = makeStyle("tone", {{"mode", std::string{"ebert"}},
                                       {"strength", 0.9},
                                       {"yellow", 0.3},
                                       {"blue", 0.5},
                                       {"alpha", 0.1},
                                       {"beta", 0.7},
                                       {"ambient", 0.15},
                                       {"diffuse", 0.4}});
  const glm::dvec3 c = kProbe.colour();
  const glm::dvec3 warm{0.3 + 0.7 * c.r, 0.3 + 0.7 * c.g, 0.7 * c.b};
  const glm::dvec3 cool{0.1 * c.r, 0.1 * c.g, 0.5 + 0.1 * c.b};
  glm::dvec3 sum = 0.15 * c;
  for (const std::size_t light : {0u, 1u}) {
    const double cosine = light == 0 ? kCosine0 : kCosine1;
    sum += warm * (1 + cosine) / 2.0 + cool * (1 - cosine) / 2.0;
    sum += 0.4 * radiance(light) * cosine * c;
  }
  expectNear(kProbe.measure({tone}).colour, 0.1 * c + 0.9 * sum);
  const double share = 0.9 * kHalfConfidence;
  expectNear(kProbe.measure({kHalfSure, tone}).colour, (1 - share) * c + share * sum);
}

TEST(ReferenceStyle, ToonHasFlatTonesAndTheColourIsTheDarkest) {
  RampProbe probe;
  const auto whiteness = [&](double tones, double softness, double intensity) {
    probe.lights = {{.direction = kNormal, .eyeSpace = false, .intensity = intensity}};
    const auto toon = makeStyle("toon", {{"tones", tones}, {"softness", softness}});
    const glm::dvec3 seen = probe.measure({toon}).colour;
    return (seen - probe.colour()) / (1.0 - probe.colour());
  };
  // q I and the tone min(q - 1, floor(q I)) over q - 1.
  const std::pair<double, double> tones[] = {
      {0.05, 0}, {0.2, 0}, {0.3, 1 / 3.0}, {0.45, 1 / 3.0}, {0.7, 2 / 3.0}, {0.8, 1}, {1.7, 1}};
  for (const auto& [intensity, tone] : tones)
    expectNear(whiteness(4, 0.1, intensity), glm::dvec3{tone});
  expectNear(whiteness(2, 0.1, 0.6), glm::dvec3{1});
  // A quarter of the way through the step at 1/4: 4 I = 1 - 0.2 / 4.
  expectNear(whiteness(4, 0.2, 0.95 / 4), glm::dvec3{0.25 / 3});
}

TEST(ReferenceStyle, ToonAddsUpLightsByTheirLuminance) {
  RampProbe probe;
  const glm::dvec3 luminance{0.2126, 0.7152, 0.0722};
  const double intensity =
      kCosine0 * glm::dot(luminance, radiance(0)) + kCosine1 * glm::dot(luminance, radiance(1));
  ASSERT_LT(intensity, 1);
  // So many tones that it lies within the step of one, half of which is 1/2 wide.
  const double tones = 3 / intensity;
  const auto toon = makeStyle("toon", {{"tones", tones}, {"softness", 1.0}, {"strength", 0.6}});
  for (const bool sure : {true, false}) {
    const double share = 0.6 * 2.5 / (tones - 1) * (sure ? 1 : kHalfConfidence);
    const Classified sample = sure ? probe.measure({toon}) : probe.measure({kHalfSure, toon});
    expectNear(sample.colour, (1 - share) * probe.colour() + share);
  }
}

TEST(ReferenceStyle, BoundaryAndSilhouetteMultiplyExtinction) {
  const auto boundary =
      makeStyle("boundary", {{"constant", 0.3}, {"scale", 2.5}, {"exponent", 1.4}});
  const auto silhouette =
      makeStyle("silhouette", {{"constant", 0.2}, {"scale", 1.5}, {"exponent", 0.8}});
  const double b = 0.3 + 2.5 * std::pow(kMagnitude, 1.4);
  const double e = 1 - std::abs(glm::dot(kNormal, kToEye));
  const double s = 0.2 + 1.5 * std::pow(e, 0.8);
  Classified sample = kProbe.measure({boundary});
  EXPECT_NEAR(sample.extinction, b, kProbeRounding);
  expectNear(sample.colour, kProbe.colour());
  EXPECT_NEAR(kProbe.measure({silhouette}).extinction, s, kProbeRounding);
  EXPECT_NEAR(kProbe.measure({boundary, silhouette}).extinction, b * s, kProbeRounding);
  EXPECT_NEAR(kProbe.measure({kHalfSure, silhouette}).extinction,
              0.2 + 1.5 * std::pow(e * kHalfConfidence, 0.8), kProbeRounding);
}

/// The probe looked at along z, in parallel: indices 2 … 9 of 0 … 11 are kept.
RampProbe probeAlongZ() {
  RampProbe probe;
  probe.camera =
      makeCamera(Projection::kOrthographic, probe.grid.centreWorld() + glm::dvec3{0, 0, 9},
                 probe.grid.centreWorld(), 1, {1, 1});
  return probe;
}

TEST(ReferenceStyle, FadeByViewDepthAndByAnyAxis) {
  const RampProbe probe = probeAlongZ();
  // A linear curve, whose mean is that of the midpoints at any step.
  const Curve line{{{-1, 0}, {2, 0.9}}};
  const auto at = [](double x) { return 0.3 * (x + 1); };
  const auto extinction = [&](const std::string& along, const glm::dvec3& axis) {
    return probe.measure({makeStyle("fade", {{"along", along}, {"axis", axis}, {"opacity", line}})})
        .extinction;
  };
  // Depth in planes of the bounding sphere, of radius √3 · 11/2: the middle of what is kept is the
  // centre.
  EXPECT_NEAR(extinction("view", {0, 0, 1}), at(0.5), kProbeRounding);
  // Along an axis across the view every sample of the ray through the centre lies in its middle.
  EXPECT_NEAR(extinction("axis", {1, 0, 0}), at(0.5), kProbeRounding);
  RampProbe aside = probe;
  aside.camera.eyeWorld += glm::dvec3{2, -1, 0};
  const auto asideAt = [&](const glm::dvec3& axis) {
    return aside
        .measure({makeStyle("fade",
                            {{"along", std::string{"axis"}}, {"axis", axis}, {"opacity", line}})})
        .extinction;
  };
  // The box's extent along (2, -1, 1) is 11 · 4, the ray's middle is 2·2 + 1 beyond its centre.
  EXPECT_NEAR(asideAt({2, -1, 1}), at(0.5 + 5 / 44.0), kProbeRounding);
  EXPECT_NEAR(asideAt({-4, 2, -2}), at(0.5 - 5 / 44.0), kProbeRounding);
}

TEST(ReferenceStyle, DepthIsAFactorThenABlendOrADistance) {
  const RampProbe probe = probeAlongZ();
  const ColourCurve factor{{{-1, {255, 0, 90}}, {2, {10, 255, 30}}}};
  const Curve blend{{{0.5, 0.4}}};
  const Colour far{30, 60, 200};
  const auto curves = makeStyle("depth", {{"factor", factor}, {"blend", blend}, {"color", far}});
  const glm::dvec3 tint = 0.5 * (Colour{255, 0, 90}.linear() + Colour{10, 255, 30}.linear());
  // Every sample's share of the pixel falls from front to back; only across the view are they
  // alike.
  const auto across = makeStyle("depth", {{"along", std::string{"axis"}},
                                          {"axis", glm::dvec3{1, 0, 0}},
                                          {"factor", factor},
                                          {"blend", blend},
                                          {"color", far}});
  expectNear(probe.measure({across}).colour, 0.6 * probe.colour() * tint + 0.4 * far.linear());
  const auto distance = makeStyle("depth", {{"along", std::string{"axis"}},
                                            {"axis", glm::dvec3{1, 0, 0}},
                                            {"mode", std::string{"distance"}},
                                            {"color", far},
                                            {"strength", 0.8},
                                            {"exponent", 2.0}});
  expectNear(probe.measure({distance}).colour, 0.8 * probe.colour() + 0.2 * far.linear());
  // Along the view: nearer samples count more, and they are the tint's first colour.
  const glm::dvec3 seen = probe.measure({curves}).colour;
  EXPECT_GT((seen.r - 0.4 * far.linear().r) / (0.6 * probe.colour().r), tint.r + 0.01);
}

TEST(ReferenceStyle, LinesByMagnitudeAndFade) {
  const Colour ink{20, 40, 120};
  const auto edges = makeStyle("edges", {{"threshold", 0.02}, {"color", ink}});
  const auto lines = makeStyle("line_surface", {{"opacity", Curve{{{0.2, 0}, {0.8, 0.9}}}}});
  const auto fade = makeStyle("fade", {{"opacity", Curve{{{0, 0.7}}}}});
  const double weight = smooth(0.02, 1, 1 - std::abs(glm::dot(kNormal, kToEye)));
  const double amount = weight * 0.9 * (kMagnitude - 0.2) / 0.6;
  Classified sample = kProbe.measure({edges, lines});
  expectNear(sample.colour, (1 - amount) * kProbe.colour() + amount * ink.linear());
  EXPECT_NEAR(sample.extinction, 1, kProbeRounding);
  sample = kProbe.measure({edges, lines, fade});
  expectNear(sample.colour, (1 - 0.7 * amount) * kProbe.colour() + 0.7 * amount * ink.linear());
  EXPECT_NEAR(sample.extinction, 0.7, kProbeRounding);
}

TEST(ReferenceStyle, LinesWithTheirOwnOpacityShowWhereNothingElseDoes) {
  const double own = -std::log1p(-0.6);
  const double unit = -std::log1p(-0.3);  // the transfer function's
  const auto edges = makeStyle("edges", {{"threshold", 0.02}});
  const double weight = smooth(0.02, 1, 1 - std::abs(glm::dot(kNormal, kToEye)));
  RampProbe probe;
  probe.lineOpacity = {{0, 0.6}, {1, 0.6}};
  EXPECT_NEAR(probe.measure({edges}).extinction, std::max(1.0, own / unit * weight),
              kProbeRounding);
  // Material that shows nothing itself gives its colour to what the lines do not replace.
  const auto nothing = makeStyle("surface", {{"opacity", Curve{{{0, 0}}}}});
  const Classified sample = probe.measure({nothing, edges});
  EXPECT_NEAR(sample.extinction, own / unit * weight, kProbeRounding);
  expectNear(sample.colour, (1 - weight) * probe.colour());
}

TEST(ReferenceStyle, ToneWithoutLightsLeavesTheColour) {
  RampProbe probe;
  probe.lights.clear();
  expectNear(probe.measure({makeStyle("tone")}).colour, probe.colour());
}

TEST(ReferenceStyle, LightComesBeforeTone) {
  const auto light = makeStyle("light", {{"ambient", 0.5}, {"diffuse", 0.0}});
  const auto tone = makeStyle("tone", {{"mode", std::string{"gooch"}}});
  RampProbe dimmed;
  const glm::dvec3 c = 0.5 * dimmed.colour();
  const glm::dvec3 warm = glm::dvec3{0.4, 0.4, 0} + 0.6 * c;
  const glm::dvec3 cool = glm::dvec3{0, 0, 0.4} + 0.2 * c;
  expectNear(dimmed.measure({light, tone}).colour,
             warm * (1 + kCosine0) / 2.0 + cool * (1 - kCosine0) / 2.0);
}

TEST(ReferenceStyle, Surface) {
  // √5/4 = 0.559 lies between the second and third point.
  const auto surface =
      makeStyle("surface", {{"opacity", Curve{{{0.1, 0.2}, {0.3, 0.4}, {0.8, 2.4}}}}});
  const Classified sample = kProbe.measure({surface});
  EXPECT_NEAR(sample.extinction, 0.4 + 2 * (kMagnitude - 0.3) / 0.5, kProbeRounding);
  expectNear(sample.colour, kProbe.colour());
}

TEST(ReferenceStyle, Edges) {
  const Colour ink{20, 40, 120};
  const auto edges =
      makeStyle("edges", {{"strength", 0.9}, {"threshold", 0.02}, {"power", 1.7}, {"color", ink}});
  const double sideways = 1 - std::abs(glm::dot(kNormal, kToEye));  // 0.68
  for (const bool sure : {true, false}) {
    const double measure = sideways * (sure ? 1 : kHalfConfidence);
    const double share = 0.9 * smooth(0.02, 1, std::pow(measure, 1.7));
    ASSERT_GT(share, 0.001);
    const Classified sample = sure ? kProbe.measure({edges}) : kProbe.measure({kHalfSure, edges});
    expectNear(sample.colour, (1 - share) * kProbe.colour() + share * ink.linear());
    EXPECT_NEAR(sample.extinction, 1, kProbeRounding);  // the larger of σ and σ·share
  }
}

TEST(ReferenceStyle, EdgesSeenByAPerspectiveEye) {
  RampProbe probe;
  probe.camera =
      makeCamera(Projection::kPerspective, probe.grid.centreWorld() + glm::dvec3{0, 0, 9},
                 probe.grid.centreWorld(), 0.3, {2, 1});
  // Pixel 1's ray: half a pixel to the right of straight ahead.
  const glm::dvec3 toEye = glm::normalize(glm::dvec3{-0.15, 0, 1});
  const auto edges = makeStyle("edges", {{"threshold", 0.0}});
  const double share = smooth(0, 1, 1 - std::abs(glm::dot(kNormal, toEye)));
  expectNear(probe.measure({edges}, 1).colour, (1 - share) * probe.colour());
}

TEST(ReferenceStyle, SpecularOfSeveralLights) {
  const auto specular = makeStyle("specular", {{"strength", 0.6}, {"exponent", 3.5}});
  const auto weight = [](const glm::dvec3& light) {
    const double cosine = glm::dot(kNormal, glm::normalize(light + kToEye));
    return 0.6 * std::pow(std::max(cosine, 0.0), 3.5);
  };
  RampProbe probe;
  probe.slopeIndex = {-1, -2, 0};  // faces the eye more or less
  probe.lights[0].direction = {1, 2, 2};
  probe.lights[1].direction = {0, 3, 1};
  const auto flipped = [&](const glm::dvec3& light) {
    const double cosine = glm::dot(-kNormal, glm::normalize(light + kToEye));
    return 0.6 * std::pow(cosine, 3.5);
  };
  const double w0 = flipped(glm::dvec3{1, 2, 2} / 3.0);
  const double w1 = flipped(glm::dvec3{0, 3, 1} / std::sqrt(10.0));
  ASSERT_GT(std::min(w0, w1), 0.01);
  ASSERT_LT(w0 + w1, 1);
  expectNear(probe.measure({specular}).colour,
             (1 - w0 - w1) * probe.colour() + w0 * radiance(0) + w1 * radiance(1));
  const double q = kHalfConfidence;
  expectNear(probe.measure({kHalfSure, specular}).colour,
             (1 - q * (w0 + w1)) * probe.colour() + q * (w0 * radiance(0) + w1 * radiance(1)));
  // The probe's own surface is turned away from one half vector and not from the other.
  expectNear(kProbe.measure({specular}).colour,
             (1 - weight(kLight0) - weight(kLight1)) * kProbe.colour() +
                 weight(kLight0) * radiance(0) + weight(kLight1) * radiance(1));
}

TEST(ReferenceStyle, LightOppositeTheEyeHasNoHighlight) {
  RampProbe probe;
  probe.lights = {
      {.direction = -(probe.camera.eyeWorld - probe.grid.centreWorld()), .eyeSpace = false}};
  const Classified sample = probe.measure({makeStyle("specular")});
  expectNear(sample.colour, probe.colour());
}

TEST(ReferenceStyle, LinesShareOneSampleAndSaturate) {
  RampProbe probe;
  // Seen exactly sideways: the edge weight is the strength. Light so that the half vector is n.
  probe.camera =
      makeCamera(Projection::kOrthographic, probe.grid.centreWorld() + glm::dvec3{0, 0, 9},
                 probe.grid.centreWorld(), 1, {1, 1});
  const glm::dvec3 towards = 2 * glm::dot(kNormal, glm::dvec3{0, 0, 1}) * kNormal;
  ASSERT_NEAR(glm::length(towards), 0, 1e-15);
  probe.lights = {{.direction = kNormal, .eyeSpace = false, .colour = {255, 200, 150}}};
  const double cosine = 1 / std::sqrt(2.0);  // between n and (n + z)/√2
  const Colour ink{20, 40, 120};
  const glm::dvec3 shine = probe.lights[0].colour.linear();
  const auto lines = [&](double edge, double specular) {
    return probe.measure({makeStyle("surface", {{"opacity", Curve{{{0, 0.25}}}}}),
                          makeStyle("edges", {{"strength", edge}, {"color", ink}}),
                          makeStyle("specular", {{"strength", specular}, {"exponent", 2.0}})});
  };
  const double ws = 0.5 * cosine * cosine;
  Classified sample = lines(0.4, 0.5);  // w = 0.4 + 0.25
  expectNear(sample.colour, 0.35 * probe.colour() + 0.4 * ink.linear() + ws * shine);
  EXPECT_NEAR(sample.extinction, 0.65, kProbeRounding);  // lines stand where the surface is faint
  sample = lines(1, 0.5);  // w = 1.25: only lines are left, in proportion
  expectNear(sample.colour, (ink.linear() + ws * shine) / 1.25);
  EXPECT_NEAR(sample.extinction, 1, kProbeRounding);
  sample = lines(0.1, 0.0);  // less than the surface itself
  EXPECT_NEAR(sample.extinction, 0.25, kProbeRounding);
}

TEST(ReferenceStyle, BelowTheNoiseFloorNothingHasADirection) {
  RampProbe probe;
  probe.gradientScale = 1000;
  const Classified sample =
      probe.measure({makeStyle("light", {{"normal_color", 1.0}}), makeStyle("tone"),
                     makeStyle("edges", {{"threshold", 0.0}}), makeStyle("specular")});
  expectNear(sample.colour, probe.colour());
  EXPECT_NEAR(sample.extinction, 1, kProbeRounding);
}

TEST(ReferenceStyle, AHomogeneousVolumeIsUnshaded) {
  RampProbe probe;
  probe.slopeIndex = {0, 0, 0};
  for (const double scale : {0.0, 1.0}) {
    probe.gradientScale = scale;
    const Classified sample =
        probe.measure({makeStyle("surface", {{"opacity", Curve{{{0, 0.5}, {1, 1}}}}}),
                       makeStyle("light", {{"normal_color", 1.0}}), makeStyle("tone"),
                       makeStyle("edges", {{"threshold", 0.0}}), makeStyle("specular")});
    expectNear(sample.colour, probe.colour());
    EXPECT_NEAR(sample.extinction, 0.5, kProbeRounding);
  }
}

}  // namespace
}  // namespace burin::test
