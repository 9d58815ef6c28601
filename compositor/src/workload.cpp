#include "burin/compositor/workload.hpp"

#include <cmath>

#include "burin/common/error.hpp"

namespace burin::compositor {

Workload denseWorkload(int participants, const Region& all, double pixels) {
  return {participants, all, pixels, static_cast<double>(participants)};
}

Workload disjointWorkload(int participants, const Region& all, double pixels) {
  return {participants, all, pixels / participants, 1.0};
}

Workload volumeWorkload(int participants, const Region& all, double pixels) {
  const double complexity = std::cbrt(participants);
  return {participants, all, pixels * complexity / participants, complexity};
}

ActivePixels activePixels(const Workload& workload) {
  const double n = workload.participants;
  BURIN_CHECK(n >= 1 && workload.depthComplexity >= 1 && workload.depthComplexity <= n);
  const double exponent = n > 1 ? std::log(n / workload.depthComplexity) / std::log(n) : 0.0;
  const auto positions = static_cast<double>(workload.all.end - workload.all.begin);
  const double density = workload.activePixels / positions;
  return [=](const Region& region, int front, int back) {
    const auto size = static_cast<double>(region.end - region.begin);
    return density * size * std::pow(back - front, exponent);
  };
}

}  // namespace burin::compositor
