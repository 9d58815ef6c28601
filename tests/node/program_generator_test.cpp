#include "program_generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "burin/common/error.hpp"
#include "burin/node/offscreen_context.hpp"
#include "gl_program.hpp"
#include "support/scenes.hpp"
#include "uniform_names.hpp"

namespace burin::node {
namespace {

using test::sceneWithStyle;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(ProgramGenerator, HoldsOnlyWhatTheSceneUses) {
  const std::string plain = generateRaycastProgram(sceneWithStyle("plain"), {}).text;
  EXPECT_THAT(plain, Not(HasSubstr("apply_")));
  EXPECT_THAT(plain, Not(HasSubstr("differencesToGradient")));
  const std::string tone = generateRaycastProgram(sceneWithStyle("tone"), {}).text;
  EXPECT_THAT(tone, HasSubstr("apply_tone"));
  EXPECT_THAT(tone, Not(HasSubstr("apply_edges")));
  for (const char* other : {"Neighbourhood", "cap", "laplacian"})
    EXPECT_THAT(tone, Not(HasSubstr(other))) << other;
}

/// What the expression's last group matches in a program's text.
std::set<std::string> matchesIn(std::string_view text, const std::regex& expression) {
  using Matches = std::regex_iterator<std::string_view::const_iterator>;
  std::set<std::string> found;
  for (Matches match{text.begin(), text.end(), expression}; match != Matches{}; ++match)
    found.insert((*match)[match->size() - 1].str());
  return found;
}

/// The names that GLSL declares outside of functions: of several in one statement the first.
std::set<std::string> declaredNames(std::string_view text) {
  static const std::regex kDeclaration{R"((?:^|\n)(?:uniform |const )?\w+ (\w+))"};
  return matchesIn(text, kDeclaration);
}

TEST(ProgramGenerator, FilesThatAreNotUsedLeaveNoWord) {
  std::size_t absent = 0;
  for (const std::string& style : test::drawnStyles()) {
    const ShaderSource source = generateRaycastProgram(sceneWithStyle(style), {});
    EXPECT_THAT(source.text, AllOf(Not(HasSubstr("#if")), Not(HasSubstr("//")))) << style;
    const std::set<std::string> words = matchesIn(source.text, std::regex{R"(\w+)"});
    const std::set<std::string> own = declaredNames(source.text);
    for (const EmbeddedShader& file : embeddedShaders()) {
      if (std::ranges::find(source.files, file.path) != source.files.end()) continue;
      for (const std::string& name : declaredNames(file.text)) {
        if (own.contains(name)) continue;  // main() and the like, each file's own
        ++absent;
        EXPECT_FALSE(words.contains(name)) << style << ": " << name << " of " << file.path;
      }
    }
  }
  EXPECT_GT(absent, 50 * test::drawnStyles().size()) << "names are found at all";
}

TEST(ProgramGenerator, TexturesAreThoseThatTheSceneNeeds) {
  static const std::regex kSampler{R"(uniform \w*sampler\w+ (\w+))"};
  const auto samplers = [](const Scene& scene) {
    return matchesIn(generateRaycastProgram(scene, {}).text, kSampler);
  };
  for (const std::string& style : test::drawnStyles()) {
    Scene scene = sceneWithStyle(style);
    std::set<std::string> expected{"volume", "cellMap"};
    if (laplacianNeeded(scene)) expected.insert("laplacianField");
    if (style != "widgets") expected.insert({"transfer0", "extinctions0"});
    if (style == "line_opacity") expected.insert({"transfer1", "extinctions1"});
    EXPECT_EQ(samplers(scene), expected) << style;
    scene.layers[0].labels = {1};
    expected.insert("labelMasks");
    EXPECT_EQ(samplers(scene), expected) << style;
  }
}

TEST(ProgramGenerator, CutsAndOperatorsAreInItWhereAStyleSeesThem) {
  Scene scene = sceneWithStyle("edges");
  scene.clip = {{{1, 0, 0}, 0}};
  scene.clipBox = ClipBox{};
  EXPECT_THAT(generateRaycastProgram(scene, {}).text, Not(HasSubstr("capAt")));
  scene.layers.push_back(sceneWithStyle("sobel").layers[0]);  // light sees cuts
  const std::string both = generateRaycastProgram(scene, {}).text;
  EXPECT_THAT(both, HasSubstr("#define CLIP_PLANES 7\n"));
  EXPECT_THAT(both, HasSubstr("#define CAPS 7\n"));
  EXPECT_THAT(both, HasSubstr("vec3 centralGradient ="));
  EXPECT_THAT(both, HasSubstr("vec3 sobelGradient ="));
  EXPECT_THAT(both, Not(HasSubstr("regressionGradient")));
  scene.clipBox->hasCap = false;
  EXPECT_THAT(generateRaycastProgram(scene, {}).text, HasSubstr("#define CAPS 1\n"));
  scene.clip[0].hasCap = false;
  EXPECT_THAT(generateRaycastProgram(scene, {}).text, Not(HasSubstr("capAt")));
}

TEST(ProgramGenerator, AStyleThatIsNotUsedIsNowhereInTheProgram) {
  for (const StyleSpec& absent : styleTable()) {
    Scene scene = sceneWithStyle("all");
    std::erase_if(scene.layers[0].styles,
                  [&](const StyleSettings& s) { return s.name == absent.name; });
    const std::string text = generateRaycastProgram(scene, {}).text;
    EXPECT_THAT(text, Not(HasSubstr("struct " + std::string{absent.name} + "_parameters")));
    if (!absent.hasSnippet) continue;
    EXPECT_THAT(text, Not(HasSubstr("apply_" + std::string{absent.name})));
    for (const ParameterSpec& parameter : absent.parameters)
      EXPECT_THAT(text, Not(HasSubstr(parameterUniform(0, absent.name, parameter.name))));
  }
  const std::string plain = generateRaycastProgram(sceneWithStyle("light"), {}).text;
  for (const char* name : {"positionAt", "evaluateCurve", "evaluateColourCurve", "transfer1"})
    EXPECT_THAT(plain, Not(HasSubstr(name)));
}

TEST(ProgramGenerator, GhostLayersAreThoseOfTheStylesUsed) {
  for (const std::string& name : test::drawnStyles()) {
    Scene scene = sceneWithStyle(name);
    scene.quality.preintegrated = false;
    const bool byGradient = scene.layers[0].transferFunction.isTwoDimensional();
    int most = byGradient ? 1 : 0;
    for (const StyleSettings& style : scene.layers[0].styles)
      most = std::max(most, findStyle(style.name)->ghostLayers);
    EXPECT_EQ(ghostLayersNeeded(scene), most) << name;
  }
}

TEST(ProgramGenerator, ValuesDoNotChangeTheText) {
  Scene scene = sceneWithStyle("all");
  const std::string before = generateRaycastProgram(scene, {}).text;
  for (StyleSettings& style : scene.layers[0].styles)
    for (ParameterValue& value : style.values)
      if (auto* number = std::get_if<double>(&value)) *number *= 0.5;
  scene.layers[0].transferFunction.points.pop_back();
  EXPECT_EQ(generateRaycastProgram(scene, {}).text, before);
}

TEST(ProgramGenerator, WidgetsAreUniformsOfTheLayersThatHaveThem) {
  Scene scene = sceneWithStyle("light");
  EXPECT_THAT(generateRaycastProgram(scene, {}).text, Not(HasSubstr("widget")));
  scene.layers.push_back(sceneWithStyle("widgets").layers[0]);
  const std::string before = generateRaycastProgram(scene, {}).text;
  EXPECT_THAT(before, HasSubstr("uniform vec4 widgets1[12]"));
  EXPECT_THAT(before, Not(HasSubstr("transfer1")));
  std::vector<TransferWidget>& widgets = scene.layers[1].transferFunction.widgets;
  widgets[0].value = {0.1, 0.2};
  widgets[0].gradient = {0.3, 0.4};
  widgets[0].shape = WidgetShape::kRectangle;  // as a triangle, another trapezoid
  widgets[1].colour = {1, 2, 3};
  widgets[1].opacity = 0;
  widgets[2].valueFalloff.reset();
  EXPECT_EQ(generateRaycastProgram(scene, {}).text, before);
  widgets.pop_back();
  EXPECT_NE(generateRaycastProgram(scene, {}).text, before);
}

TEST(ProgramGenerator, EveryPairOfStylesCompiles) {
  const OffscreenContext context{{}};
  for (unsigned set = 0; set < test::kStyleSets; ++set) {
    Scene scene = test::sceneWithStyleSet(set);
    const ProgramOptions options{.invalidVoxels = set % 3 == 0, .countSamples = set % 4 == 0};
    if (set % 5 == 0) scene.clip = {{{1, 0, 0}, 0}, {{0, 1, 0}, 0}};
    EXPECT_NO_THROW((GlProgram{fullscreenVertexSource(), generateRaycastProgram(scene, options)}))
        << set;
  }
}

TEST(ProgramGenerator, EverySlicePassCompiles) {
  const OffscreenContext context{{}};
  unsigned number = 0;
  for (const std::string& style : test::drawnStyles())
    for (const LayerPass pass : {LayerPass::kColour, LayerPass::kLines})
      for (const SliceTarget target : {SliceTarget::kFrame, SliceTarget::kLayerImage}) {
        Scene scene = sceneWithStyle(style);
        scene.quality.preintegrated = number % 2 == 0;
        if (number % 5 == 0) scene.clip = {{{1, 0, 0}, 0}};
        const ProgramOptions options{.invalidVoxels = number % 3 == 0,
                                     .countSamples = number % 4 == 0};
        EXPECT_NO_THROW((GlProgram{fullscreenVertexSource(),
                                   generateSliceProgram(scene, pass, target, options)}))
            << style << " " << number;
        ++number;
      }
  for (const std::size_t layers : {1u, 2u, 16u})
    EXPECT_NO_THROW((GlProgram{fullscreenVertexSource(), generateResolveProgram(layers)}));
}

TEST(ProgramGenerator, EveryWordOfEveryStyleCompiles) {
  const OffscreenContext context{{}};
  for (const StyleSpec& style : styleTable())
    for (std::size_t i = 0; i < style.parameters.size(); ++i)
      for (const std::string_view word : style.parameters[i].choices) {
        Scene scene = sceneWithStyle("light");
        StyleSettings settings = defaultSettings(style);
        settings.values[i] = std::string{word};
        std::erase_if(scene.layers[0].styles,
                      [&](const StyleSettings& s) { return s.name == style.name; });
        scene.layers[0].styles.push_back(settings);
        EXPECT_NO_THROW((GlProgram{fullscreenVertexSource(), generateRaycastProgram(scene, {})}))
            << style.name << " " << word;
      }
}

TEST(GlProgram, MoreLayersThanThereAreTexturesForAreRefused) {
  const OffscreenContext context{{}};
  GLint most = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &most);
  Scene scene = sceneWithStyle("plain");
  // The volume and its distance map, and two for each layer: one more than there are.
  scene.layers.resize(static_cast<std::size_t>(most) / 2, scene.layers[0]);
  try {
    const GlProgram program{fullscreenVertexSource(), generateRaycastProgram(scene, {})};
    FAIL() << "linked";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(std::to_string(2 + 2 * scene.layers.size())),
                                    HasSubstr("fewer layers"), HasSubstr("preintegrated")));
    EXPECT_EQ(error.code(), ExitCode::kUsage);
  }
}

TEST(GlProgram, ErrorsNameFileAndLine) {
  const OffscreenContext context{{}};
  const ShaderSource broken = expandIncludes(
      "#version 450 core\n#include \"lattice.glsl\"\n// a comment\nvoid main() {\n"
      "  undeclared = 1.0;\n}\n",
      "broken.frag");
  try {
    const GlProgram program{fullscreenVertexSource(), broken};
    FAIL() << "compiled";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("broken.frag:5"));
    EXPECT_EQ(error.code(), ExitCode::kRank);
  }
}

}  // namespace
}  // namespace burin::node
