#include "burin/common/named_style.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "schema_check.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

const fs::path kStyles = fs::path{BURIN_CONFIGS_DIR} / "styles";

/// BURIN_STYLES for the time of a test.
class ChosenFolders {
 public:
  explicit ChosenFolders(const std::string& folders) { setenv("BURIN_STYLES", folders.c_str(), 1); }
  ~ChosenFolders() { unsetenv("BURIN_STYLES"); }
  ChosenFolders(const ChosenFolders&) = delete;
  ChosenFolders& operator=(const ChosenFolders&) = delete;
};

/// The effects of a scene whose only layer has this "style".
std::vector<StyleSettings> effectsOf(const std::string& style,
                                     const std::vector<std::string>& overrides = {},
                                     const std::string& name = "scene.json") {
  const std::string text = R"({ "schema_version": 1, "layers": [{ "style": )" + style +
                           R"(, "transfer_function": { "points": [
                             { "value": 1, "color": "#fff", "opacity": 0.5 }] } }] })";
  return parseScene(text, name, overrides).layers[0].styles;
}

std::string styleMessageOf(const std::string& style, const std::string& name = "scene.json") {
  try {
    effectsOf(style, {}, name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  return "accepted";
}

const StyleSettings* find(const std::vector<StyleSettings>& effects, std::string_view name) {
  const auto found =
      std::find_if(effects.begin(), effects.end(), [&](const auto& e) { return e.name == name; });
  return found == effects.end() ? nullptr : &*found;
}

TEST(NamedStyles, EachFileIsAStyleOfItsOwn) {
  const std::vector<NamedStyle> styles = findNamedStyles({kStyles});
  ASSERT_GE(styles.size(), 12u);
  const auto schema = nlohmann::json::parse(sceneSchemaJson());
  const auto& ofStyle = schema["properties"]["layers"]["items"]["properties"]["style"]["anyOf"][1];
  for (std::size_t i = 0; i < styles.size(); ++i) {
    SCOPED_TRACE(styles[i].name);
    std::ifstream stream{kStyles / (styles[i].name + ".json"), std::ios::binary};
    const std::string text{std::istreambuf_iterator<char>{stream}, {}};
    EXPECT_THAT(text, StartsWith("// "));
    EXPECT_EQ(
        test::schemaViolation(nlohmann::json::parse(text, nullptr, true, true)["style"], ofStyle),
        "");
    EXPECT_FALSE(styles[i].description.empty());
    EXPECT_LE(styles[i].description.size(), 80u) << "is no line of `burin styles`";
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(styles[i].effects, styles[j].effects);
  }
}

TEST(NamedStyles, ANameStandsForTheFilesContent) {
  const ChosenFolders folders{kStyles.string()};
  for (const NamedStyle& style : findNamedStyles({kStyles}))
    EXPECT_EQ(effectsOf('"' + style.name + '"'), style.effects) << style.name;
}

TEST(NamedStyles, EntriesBesideABaseChangeIt) {
  const test::TemporaryFolder folder;
  folder.write("mine.json", R"({ "description": "d", "style": {
      "tone": { "strength": 0.5, "warm": "#123456" }, "edges": { "power": 3 } } })");
  const ChosenFolders folders{folder.path().string()};
  const auto effects = effectsOf(
      R"({ "base": "mine", "without": ["edges"], "tone": { "strength": 0.3 }, "light": {} })");
  EXPECT_EQ(effects, effectsOf(R"({ "tone": { "strength": 0.3, "warm": "#123456" },
                                    "light": {} })"));
}

TEST(NamedStyles, SettingsOfTheCommandLineReachInto) {
  const test::TemporaryFolder folder;
  folder.write("mine.json", R"({ "description": "d", "style": { "tone": {}, "edges": {} } })");
  const ChosenFolders folders{folder.path().string()};
  const auto effects =
      effectsOf(R"("mine")", {"layers.0.style.tone.strength=0.25", "layers.0.style.edges=null"});
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].number("strength"), 0.25);
  EXPECT_EQ(effectsOf("{}", {"layers.0.style=mine"}).size(), 2u);
  EXPECT_EQ(effectsOf("{}", {"layers.0.style.base=mine"}).size(), 2u);
}

TEST(NamedStyles, AreWrittenWithAllTheirParameters) {
  const ChosenFolders folders{kStyles.string()};
  const std::string text = R"({ "schema_version": 1, "layers": [{ "style": "technical",
      "transfer_function": { "points": [{ "value": 1, "color": "#fff", "opacity": 0.5 }] } }] })";
  const Scene scene = parseScene(text, "scene.json");
  const std::string written = writeScene(scene);
  EXPECT_THAT(written, testing::Not(HasSubstr("technical")));
  setenv("BURIN_STYLES", "/nowhere", 1);  // what is written needs no style file any more
  EXPECT_EQ(parseScene(written, "scene.json"), scene);
}

TEST(NamedStyles, TheFirstFolderWins) {
  const test::TemporaryFolder first, second;
  first.write("a.json", R"({ "description": "first", "style": { "light": {} } })");
  second.write("a.json", R"({ "description": "second", "style": { "tone": {} } })");
  second.write("b.json", R"({ "description": "other", "style": {} })");
  const ChosenFolders folders{"/nowhere::" + first.path().string() + ":" + second.path().string()};
  const auto styles = findNamedStyles({first.path(), second.path()});
  ASSERT_EQ(styles.size(), 2u);
  EXPECT_EQ(styles[0].description, "first");
  EXPECT_NE(find(effectsOf(R"("a")"), "light"), nullptr);
  EXPECT_TRUE(effectsOf(R"("b")").empty());
}

TEST(NamedStyles, APathIsRelativeToTheScene) {
  const test::TemporaryFolder folder;
  folder.write("mine.json", R"({ "description": "d", "style": { "specular": {} } })");
  const std::string scene = folder / "scene.json";
  EXPECT_NE(find(effectsOf(R"("mine.json")", {}, scene), "specular"), nullptr);
  EXPECT_NE(find(effectsOf(R"({ "base": "./mine.json" })", {}, scene), "specular"), nullptr);
}

TEST(NamedStyles, MistakesAreNamedWithTheirPlace) {
  const test::TemporaryFolder folder;
  folder.write("good.json", R"({ "description": "d", "style": { "light": {} } })");
  folder.write("bad.json", "{ \"description\": \"d\",\n  \"style\": { \"lihgt\": {} } }");
  folder.write("nested.json", R"({ "description": "d", "style": { "base": "good" } })");
  folder.write("short.json", R"({ "style": {} })");
  const ChosenFolders folders{folder.path().string()};
  EXPECT_THAT(styleMessageOf(R"("god")"),
              HasSubstr("layers[0].style: style 'god' is unknown; did you "
                        "mean 'good'?"));
  EXPECT_THAT(styleMessageOf(R"({ "base": "god" })"),
              HasSubstr("layers[0].style.base: style 'god'"));
  EXPECT_THAT(styleMessageOf(R"({ "base": 3 })"),
              HasSubstr("expected the name of a style, found 3"));
  EXPECT_THAT(styleMessageOf(R"("bad")"),
              HasSubstr((folder / "bad.json") + ":2:14: layers[0].style.lihgt"));
  EXPECT_THAT(styleMessageOf(R"("nested")"), HasSubstr("a named style has no base"));
  EXPECT_THAT(styleMessageOf(R"("short")"), HasSubstr("expected 'description' and 'style'"));
  EXPECT_THAT(styleMessageOf(R"("./none.json")"), HasSubstr("none.json: cannot read the style"));
  EXPECT_THAT(styleMessageOf(R"({ "base": "good", "without": ["tone"] })"),
              HasSubstr("layers[0].style.without[0]: the named style has no \"tone\""));
}

}  // namespace
}  // namespace burin
