#include "burin/node/step_map.hpp"

#include <algorithm>

namespace burin::node {

std::vector<StepRun> stepRuns(const StepMap& map, const PixelRect& area) {
  std::vector<StepRun> runs;
  const int side = map.tilePixels;
  for (int row = 0; row < map.rows(); ++row)
    for (int column = 0; column < map.columns;) {
      const double step = map.at(column, row);
      const int first = column;
      while (column < map.columns && map.at(column, row) == step) ++column;
      const PixelRect tiles{first * side, row * side, column * side, (row + 1) * side};
      const PixelRect pixels{std::max(tiles.x0, area.x0), std::max(tiles.y0, area.y0),
                             std::min(tiles.x1, area.x1), std::min(tiles.y1, area.y1)};
      if (step > 0 && pixels.x0 < pixels.x1 && pixels.y0 < pixels.y1)
        runs.push_back({step, pixels});
    }
  std::ranges::stable_sort(runs, std::ranges::greater{}, &StepRun::step);
  return runs;
}

}  // namespace burin::node
