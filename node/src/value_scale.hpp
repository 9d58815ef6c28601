#pragma once

#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::node {

/// How textures hold values: data value = lowest + range * stored, stored in [0, 1].
struct ValueScale {
  double lowest = 0;
  double range = 1;          ///< > 0
  bool hasInvalid = false;   ///< NaN voxels: textures hold (f * valid, valid)
  double highest = 1;        ///< of the volume's values; above lowest, below or at lowest + range
  double largestStored = 1;  ///< stored value of the largest float: 0 where all are equal

  double stored(double value) const { return (value - lowest) / range; }
  double value(double stored) const { return lowest + range * stored; }
};

/// Integers by their type's range (so every volume of a type is stored alike and exactly), floats
/// by the volume's finite range.
ValueScale valueScaleOf(VoxelType type, const VolumeSurvey& survey);

}  // namespace burin::node
