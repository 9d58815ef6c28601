#pragma once

#include <cstddef>
#include <functional>

#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// How many active pixels the combination of participants [front, back) has in `region`: known
/// exactly from a frame's counts, or guessed from a Workload.
using ActivePixels = std::function<double(const Region& region, int front, int back)>;

/// What there is to composite, all participants and all positions alike.
struct Workload {
  int participants = 1;
  Region all;                  ///< as in the schedule: positions in the sequence
  double activePixels = 0.0;   ///< that one participant drew
  double depthComplexity = 1;  ///< participants that drew one and the same pixel: 1 … participants
};

/// Everybody drew all of `pixels` pixels: the most there can be to combine.
Workload denseWorkload(int participants, const Region& all, double pixels);

/// Everybody drew an equal part of `pixels` pixels and no two the same one.
Workload disjointWorkload(int participants, const Region& all, double pixels);

/// A convex volume that covers `pixels` pixels, cut into as many bricks: a line of sight meets
/// about the cube root of them.
Workload volumeWorkload(int participants, const Region& all, double pixels);

/// A workload as counts. A block of b participants covers b^(log(n/c) / log n) times the pixels one
/// of them covers, n participants, depth complexity c: the power law that is right for one and for
/// all of them, hence exact for c = 1 and c = n; and for bricks of a k-d tree, c = n^(1/3), a block
/// is itself a volume and covers b^(2/3).
ActivePixels activePixels(const Workload& workload);

}  // namespace burin::compositor
