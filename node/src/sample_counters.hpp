#pragma once

#include "burin/common/statistics.hpp"
#include "gl.hpp"

namespace burin::node {

/// The sample counters that programs with COUNT_SAMPLES add to, 32 bits each. Its OffscreenContext
/// must be current.
class SampleCounters {
 public:
  SampleCounters();

  /// Sets them to 0 for the draws that follow.
  void begin();
  /// Adds what was counted since.
  void addTo(RankStatistics& statistics);

 private:
  Buffer buffer_;
};

}  // namespace burin::node
