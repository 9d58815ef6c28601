#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace burin::node {

/// One file of node/shaders, embedded by the build.
struct EmbeddedShader {
  std::string_view path;  ///< relative to node/shaders
  std::string_view text;
};
std::span<const EmbeddedShader> embeddedShaders();

/// GLSL with every `#include "path"` replaced by the file (each file once), without comments and
/// what its conditions leave out (ShaderConditions): what a program does not use is not in its
/// text.
struct ShaderSource {
  /// Where a line of the text stands.
  struct Place {
    std::size_t file;  ///< of `files`
    int line;          ///< from 1
  };
  std::string text;
  std::vector<Place> lines;  ///< of the text
  std::vector<std::string> files;
};

/// Expands `text`, known as `name` in messages. BURIN_CHECKs that included files exist and that
/// conditions are complete.
ShaderSource expandIncludes(std::string_view text, std::string_view name);

/// A compiler log with the text's lines replaced by files and theirs: "tone.glsl:12(4): …".
std::string namedLog(std::string_view log, const ShaderSource& source);

}  // namespace burin::node
