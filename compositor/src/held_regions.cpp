#include "held_regions.hpp"

#include <algorithm>

namespace burin::compositor {

HeldRegions::HeldRegions(const Region& all) {
  if (!all.empty()) regions_.push_back(all);
}

/// The one that contains it all: two never touch, for nothing is ever put back.
std::vector<Region>::const_iterator HeldRegions::find(const Region& region) const {
  return std::ranges::find_if(regions_, [&](const Region& held) {
    return held.begin <= region.begin && region.end <= held.end;
  });
}

bool HeldRegions::take(const Region& region) {
  const auto found = find(region);
  if (found == regions_.end()) return false;
  const Region before{found->begin, region.begin};
  const Region after{region.end, found->end};
  auto place = regions_.erase(found);
  if (!after.empty()) place = regions_.insert(place, after);
  if (!before.empty()) regions_.insert(place, before);
  return true;
}

bool HeldRegions::isExactly(const Region& region) const {
  return region.empty() ? regions_.empty() : regions_.size() == 1 && regions_.front() == region;
}

bool HeldRegions::contains(const Region& region) const {
  return find(region) != regions_.end();
}

}  // namespace burin::compositor
