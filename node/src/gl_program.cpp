#include "gl_program.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "burin/common/error.hpp"
#include "burin/common/trace.hpp"

namespace burin::node {
namespace {

Shader compile(GLenum stage, const ShaderSource& source) {
  Shader shader{gl().CreateShader(stage)};
  const char* text = source.text.c_str();
  gl().ShaderSource(shader.id(), 1, &text, nullptr);
  gl().CompileShader(shader.id());
  GLint done = GL_FALSE;
  gl().GetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  GLint length = 0;
  gl().GetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  gl().GetShaderInfoLog(shader.id(), length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  fail(ExitCode::kRank, "{}: does not compile:\n{}", source.files.front(), namedLog(log, source));
}

/// Layers have textures of their own, of which a program may have only so many.
void checkTextures(const ShaderSource& source) {
  constexpr std::string_view kUniform = "\nuniform ";
  int textures = 0;
  for (std::size_t at = 0; (at = source.text.find(kUniform, at)) != std::string::npos;) {
    at += kUniform.size();
    if (source.text.substr(at, source.text.find(' ', at) - at).find("sampler") != std::string::npos)
      ++textures;
  }
  GLint most = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &most);
  if (textures <= most) return;
  fail(
      ExitCode::kUsage,
      "the scene's layers need {} textures at once, of which this OpenGL has {}: use fewer layers, "
      "quality.preintegrated=false (one texture for each instead of two) or --technique slices (a "
      "layer at a time)",
      textures, most);
}

}  // namespace

GlProgram::GlProgram(const ShaderSource& vertex, const ShaderSource& fragment)
    : program_{gl().CreateProgram()} {
  const TraceSpan span{"compile"};
  checkTextures(fragment);
  const Shader vertexShader = compile(GL_VERTEX_SHADER, vertex);
  const Shader fragmentShader = compile(GL_FRAGMENT_SHADER, fragment);
  const GLuint id = program_.id();
  gl().AttachShader(id, vertexShader.id());
  gl().AttachShader(id, fragmentShader.id());
  gl().LinkProgram(id);
  GLint done = GL_FALSE;
  gl().GetProgramiv(id, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return;
  std::string log(4096, '\0');
  GLint length = 0;
  gl().GetProgramInfoLog(id, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  fail(ExitCode::kRank, "{}: does not link: {}", fragment.files.front(), log);
}

GLint GlProgram::location(const std::string& uniform) const {
  const auto [entry, isNew] = locations_.try_emplace(uniform, -1);
  if (isNew) entry->second = gl().GetUniformLocation(program_.id(), uniform.c_str());
  return entry->second;
}

void GlProgram::set(const std::string& uniform, float value) const {
  gl().ProgramUniform1f(program_.id(), location(uniform), value);
}
void GlProgram::set(const std::string& uniform, int value) const {
  gl().ProgramUniform1i(program_.id(), location(uniform), value);
}
void GlProgram::set(const std::string& uniform, const glm::vec2& value) const {
  gl().ProgramUniform2fv(program_.id(), location(uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const std::string& uniform, const glm::vec3& value) const {
  gl().ProgramUniform3fv(program_.id(), location(uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const std::string& uniform, const glm::vec4& value) const {
  gl().ProgramUniform4fv(program_.id(), location(uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const std::string& uniform, const glm::mat3& value) const {
  gl().ProgramUniformMatrix3fv(program_.id(), location(uniform), 1, GL_FALSE,
                               glm::value_ptr(value));
}
void GlProgram::set(const std::string& uniform, const std::vector<float>& values) const {
  if (values.empty()) return;
  gl().ProgramUniform1fv(program_.id(), location(uniform), static_cast<GLsizei>(values.size()),
                         values.data());
}
void GlProgram::set(const std::string& uniform, const std::vector<glm::vec3>& values) const {
  if (values.empty()) return;
  gl().ProgramUniform3fv(program_.id(), location(uniform), static_cast<GLsizei>(values.size()),
                         glm::value_ptr(values.front()));
}
void GlProgram::set(const std::string& uniform, const std::vector<glm::vec4>& values) const {
  if (values.empty()) return;
  gl().ProgramUniform4fv(program_.id(), location(uniform), static_cast<GLsizei>(values.size()),
                         glm::value_ptr(values.front()));
}

}  // namespace burin::node
