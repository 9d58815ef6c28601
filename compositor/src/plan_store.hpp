#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// The plans of a lazy schedule for who comes back to each many times: short ones are kept, long
/// ones (direct send among thousands, which has one round only) are made again.
class PlanStore {
 public:
  explicit PlanStore(const LazySchedule& schedule)
      : schedule_{schedule}, plans_(static_cast<std::size_t>(schedule.participants)) {}

  /// Valid until the next call.
  const Plan& get(int participant) {
    Entry& entry = plans_[static_cast<std::size_t>(participant)];
    if (entry.isKept) return entry.plan;
    scratch_ = schedule_.plan(participant);
    if (scratch_.steps.size() > kKeptSteps) return scratch_;
    scratch_.steps.shrink_to_fit();
    entry.plan = std::move(scratch_);
    entry.isKept = true;
    return entry.plan;
  }

 private:
  static constexpr std::size_t kKeptSteps = 128;  // 4 kB: 270 MB among 65,536, if all were as long
  struct Entry {
    Plan plan;
    bool isKept = false;
  };

  const LazySchedule& schedule_;
  std::vector<Entry> plans_;
  Plan scratch_;
};

}  // namespace burin::compositor
