#pragma once

#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "gl.hpp"
#include "shader_source.hpp"

namespace burin::node {

/// A linked program with its uniforms by name. Setting a uniform that the compiler dropped does
/// nothing. Its OffscreenContext must be current, here and later.
class GlProgram {
 public:
  /// Throws Error{kRank} with the compiler's messages by file and line, Error{kUsage} if the scene
  /// takes more textures than a program can have.
  GlProgram(const ShaderSource& vertex, const ShaderSource& fragment);

  void use() const { gl().UseProgram(program_.id()); }
  GLint location(const std::string& uniform) const;

  void set(const std::string& uniform, float value) const;
  void set(const std::string& uniform, int value) const;
  void set(const std::string& uniform, const glm::vec2& value) const;
  void set(const std::string& uniform, const glm::vec3& value) const;
  void set(const std::string& uniform, const glm::vec4& value) const;
  void set(const std::string& uniform, const glm::mat3& value) const;
  void set(const std::string& uniform, const std::vector<float>& values) const;
  void set(const std::string& uniform, const std::vector<glm::vec3>& values) const;
  void set(const std::string& uniform, const std::vector<glm::vec4>& values) const;

 private:
  Program program_;
  mutable std::unordered_map<std::string, GLint> locations_;
};

}  // namespace burin::node
