#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "burin/common/scene.hpp"
#include "curve_code.hpp"

namespace burin::node {

/// The statements that fill `<style>_parameters p` for one layer, the uniforms they read, and what
/// copies those before the loop.
struct ParameterCode {
  std::string uniforms;
  std::string prepare;
  std::string statements;
};

/// `curves` gets the style's curves.
ParameterCode parameterCode(const StyleSettings& settings, const StyleSpec& style,
                            std::size_t layer, CurveCode& curves);

/// The parameters' structures and the functions of all styles that the scene uses.
std::string styleCode(const Scene& scene);

/// Declares a uniform and the copy of it that the loop over samples reads (see `one` in
/// lattice.glsl); returns the copy's name. `prepare` gets the statement that copies.
std::string keepUniform(std::string_view type, const std::string& uniform,
                        std::string& declarations, std::string& prepare);

}  // namespace burin::node
