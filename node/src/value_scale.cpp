#include "value_scale.hpp"

namespace burin::node {

ValueScale valueScaleOf(VoxelType type, const VolumeSurvey& survey) {
  const double span = survey.highest - survey.lowest;
  const double range = span > 0 ? span : 1.0;
  const double highest = survey.lowest + range;
  switch (type) {
    case VoxelType::kU8:
      return {0, 255, false, highest};
    case VoxelType::kU16:
    case VoxelType::kI16:
      return {survey.lowest, 65535, false, highest};
    case VoxelType::kF32:
      break;
  }
  return {survey.lowest, range, survey.nanCount > 0, highest, span > 0 ? 1.0 : 0.0};
}

}  // namespace burin::node
