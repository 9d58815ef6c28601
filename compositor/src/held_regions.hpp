#pragma once

#include <vector>

#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// The positions a participant still holds: disjoint regions, ascending, none empty.
class HeldRegions {
 public:
  explicit HeldRegions(const Region& all);
  /// Takes `region` out; false, with nothing changed, if not all of it is held.
  bool take(const Region& region);
  /// Whether exactly `region` is held (nothing, if that is empty).
  bool isExactly(const Region& region) const;
  bool contains(const Region& region) const;

 private:
  std::vector<Region>::const_iterator find(const Region& region) const;

  std::vector<Region> regions_;
};

}  // namespace burin::compositor
