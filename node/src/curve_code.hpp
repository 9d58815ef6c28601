#pragma once

#include <cstddef>
#include <string>

#include "burin/common/style.hpp"

namespace burin::node {

/// Numbers the curves of a scene and writes the functions that evaluate them: sums of clamped
/// ramps, exact at any resolution. Of a curve, the elements of the uniform array are (start value,
/// -, -) and then (x, length, slope); of a curve of colours they are the first colour and then each
/// colour's difference to the one before, and those of the array `rampsUniform(uniform)` (x,
/// length, 1 / length).
class CurveCode {
 public:
  /// The number that evaluateCurve() knows the curve by.
  int add(const std::string& uniform, const Curve& curve);
  /// The number that evaluateColourCurve() knows it by.
  int add(const std::string& uniform, const ColourCurve& curve);

  /// Statements that copy the uniforms before the loop over samples (see `one` in lattice.glsl).
  const std::string& prepare() const { return prepare_; }
  /// Uniforms and functions.
  std::string text() const;

 private:
  /// Declares a uniform array and the copy of it that is read; returns the copy's name.
  std::string keepArray(const std::string& uniform, std::size_t size);

  int curves_ = 0;
  int colourCurves_ = 0;
  std::string declarations_;
  std::string prepare_;
  std::string cases_;
  std::string colourCases_;
};

/// The array of a curve of colours that says where its ramps lie.
std::string rampsUniform(const std::string& uniform);

}  // namespace burin::node
