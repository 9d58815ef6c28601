#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "schema_check.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;
const fs::path kConfigs = BURIN_CONFIGS_DIR;
const fs::path kInvalid = BURIN_INVALID_CONFIGS_DIR;

std::string readText(const fs::path& file) {
  std::ifstream stream{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

std::vector<fs::path> jsonFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator{folder}) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  return files;
}

nlohmann::json parsed(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, true, true);
}

TEST(Configs, SchemaIsTheGeneratedOne) {
  EXPECT_EQ(readText(kConfigs / "schema.json"), sceneSchemaJson())
      << "run: cmake --build <folder> --target schema";
}

TEST(Configs, EveryFileIsAValidScene) {
  const std::vector<fs::path> files = jsonFiles(kConfigs / "scenes");
  ASSERT_GE(files.size(), 5u);
  const nlohmann::json schema = parsed(sceneSchemaJson());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string text = readText(file);
    EXPECT_THAT(text, testing::StartsWith("// ")) << "a header says what the scene shows";
    Scene scene;
    ASSERT_NO_THROW(scene = loadScene(file));
    EXPECT_EQ(parseScene(writeScene(scene), "round trip"), scene);
    EXPECT_EQ(test::schemaViolation(parsed(text), schema), "");
    EXPECT_EQ(test::schemaViolation(parsed(writeScene(scene)), schema), "");
  }
}

TEST(Configs, InvalidFilesGiveTheirOwnMessages) {
  // The first line of each file is "// <the message behind the file's name>".
  const std::vector<fs::path> files = jsonFiles(kInvalid);
  ASSERT_GE(files.size(), 12u);
  std::set<std::string> messages;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string text = readText(file);
    const std::string expected = text.substr(3, text.find('\n') - 3);
    try {
      loadScene(file);
      ADD_FAILURE() << "is accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_EQ(error.what(), file.string() + ":" + expected);
      EXPECT_TRUE(messages.insert(expected).second) << "is another file's message too";
    }
  }
}

TEST(Schema, KnowsEveryStyleParameter) {
  const nlohmann::json schema = parsed(sceneSchemaJson());
  const auto& layer = schema["properties"]["layers"]["items"]["properties"];
  const auto& styles = layer["style"]["anyOf"][1]["properties"];  // [0] is a name
  for (const StyleSpec& style : styleTable()) {
    for (const ParameterSpec& p : style.parameters) {
      SCOPED_TRACE(std::string{style.name} + "." + std::string{p.name});
      const auto& key = styles.at(std::string{style.name}).at("properties").at(std::string{p.name});
      EXPECT_THAT(key.at("description").get<std::string>(),
                  testing::StartsWith(std::string{p.help}));
      if (const auto* number = std::get_if<double>(&p.defaultValue)) {
        EXPECT_EQ(key.at("default").get<double>(), *number);
        EXPECT_EQ(key.at("minimum").get<double>(), p.minimum);
        EXPECT_EQ(key.at("maximum").get<double>(), p.maximum);
      }
    }
  }
}

TEST(Schema, EveryObjectIsClosedAndEveryKeyDescribed) {
  const nlohmann::json schema = parsed(sceneSchemaJson());
  int objects = 0;
  const std::function<void(const nlohmann::json&)> visit = [&](const nlohmann::json& node) {
    if (node.is_object() && node.contains("properties") && node.contains("type")) {
      ++objects;
      EXPECT_EQ(node.at("additionalProperties"), false);
      for (const auto& [name, key] : node.at("properties").items()) {
        EXPECT_TRUE(key.contains("description")) << name;
      }
    }
    for (const auto& child : node) {
      if (child.is_structured()) visit(child);
    }
  };
  visit(schema);
  EXPECT_GE(objects, 10);
}

}  // namespace
}  // namespace burin
