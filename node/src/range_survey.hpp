#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "burin/node/survey.hpp"

namespace burin::node {

/// Ranges of blocks and of the whole, NaN and infinity counts, of z slices that come in ascending
/// order. Covers what one rank saw; ranks' results merge by minimum, maximum and sum.
class RangeSurvey {
 public:
  virtual ~RangeSurvey() = default;
  /// Slice z, whole in x and y, of the source's type.
  virtual void addSlice(int z, std::span<const std::byte> voxels) = 0;
  /// After the last slice; writes what was seen into `survey`, whose blocks it creates.
  virtual void finish(VolumeSurvey& survey) = 0;
};

std::unique_ptr<RangeSurvey> makeRangeSurvey(const VolumeInfo& info);

}  // namespace burin::node
