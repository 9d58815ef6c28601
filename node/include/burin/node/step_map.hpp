#pragma once

#include <vector>

#include "burin/common/image.hpp"

namespace burin::node {

/// The distance of sample planes by tiles of a frame, in voxels as quality.step_voxels. A pixel's
/// samples depend on its own tile's step alone, so tiles change nothing but what they cost.
struct StepMap {
  int tilePixels = 32;        ///< side of a tile; the last column and row may be cut
  int columns = 0;            ///< tiles side by side
  std::vector<double> steps;  ///< row by row; 0: nothing is drawn there

  StepMap() = default;
  StepMap(ImageSize frame, int side, double step)
      : tilePixels{side},
        columns{(frame.width + side - 1) / side},
        steps(static_cast<std::size_t>(columns) *
                  static_cast<std::size_t>((frame.height + side - 1) / side),
              step) {}
  int rows() const { return static_cast<int>(steps.size()) / columns; }
  double& at(int column, int row) {
    return steps[static_cast<std::size_t>(row * columns + column)];
  }
  double at(int column, int row) const {
    return steps[static_cast<std::size_t>(row * columns + column)];
  }
};

/// Tiles of one step that lie side by side.
struct StepRun {
  double step;
  PixelRect pixels;
};
/// All of a map's runs within `area`, coarsest step first.
std::vector<StepRun> stepRuns(const StepMap& map, const PixelRect& area);

}  // namespace burin::node
