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

/// GLSL with every `#include "path"` replaced by the file (each file once), and enough `#line`
/// directives that a compile error names file and line.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  ///< by GLSL source-string number
};

/// Expands `text`, known as `name` in messages. BURIN_CHECKs that included files exist.
ShaderSource expandIncludes(std::string_view text, std::string_view name);

/// A compiler log with source-string numbers replaced by file names: "tone.glsl:12: …".
std::string namedLog(std::string_view log, const ShaderSource& source);

}  // namespace burin::node
