#include "step_choice.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/log.hpp"
#include "burin/common/scene.hpp"

namespace burin::host {

namespace {

constexpr int kTilePixels = 32;
/// The small picture has at least as many pixels on its shorter side, if the whole one has, and at
/// least one in eight: thin things must not fall through between its rays.
constexpr int kSmallSide = 128;
constexpr int kLargestPart = 8;
constexpr double kSafety = 4;
constexpr double kSmallestStep = 1.0 / 128;

/// How many times smaller the small picture is.
int partOf(ImageSize whole) {
  int part = 1;
  while (part < kLargestPart && std::min(whole.width, whole.height) / (2 * part) >= kSmallSide)
    part *= 2;
  return part;
}

/// The same view in fewer pixels.
Camera smaller(Camera camera, int part) {
  const ImageSize whole = camera.image;
  camera.image = {(whole.width + part - 1) / part, (whole.height + part - 1) / part};
  camera.pixelSize *= part;
  return camera;
}

/// Largest change of a channel in each tile between two small pictures.
std::vector<double> changes(ImageView<const Rgba> a, const Image<Rgba>& b,
                            const node::StepMap& tiles) {
  std::vector<double> largest(tiles.steps.size());
  for (int y = 0; y < b.size().height; ++y)
    for (int x = 0; x < b.size().width; ++x) {
      const Rgba& p = a.row(y)[static_cast<std::size_t>(x)];
      const Rgba& q = b.at(x, y);
      double& tile = largest[static_cast<std::size_t>(y / tiles.tilePixels * tiles.columns +
                                                      x / tiles.tilePixels)];
      for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a})
        tile = std::max(tile, std::abs(double{d}));
    }
  return largest;
}

/// Calls visit(i) for a tile and its neighbours, i the place in `steps`.
template <typename Visit>
void around(const node::StepMap& tiles, int column, int row, Visit&& visit) {
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, tiles.rows() - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, tiles.columns - 1); ++x)
      visit(static_cast<std::size_t>(y * tiles.columns + x));
}

/// `step` in and next to the tiles that have none yet, nothing elsewhere.
void probeOpenTiles(const node::StepMap& chosen, double step, node::StepMap& probe) {
  std::ranges::fill(probe.steps, 0);
  for (int row = 0; row < chosen.rows(); ++row)
    for (int column = 0; column < chosen.columns; ++column)
      if (chosen.at(column, row) == 0)
        around(probe, column, row, [&](std::size_t i) { probe.steps[i] = step; });
}

void copyTo(Image<Rgba>& image, ImageView<const Rgba> from) {
  for (int y = 0; y < image.size().height; ++y)
    std::ranges::copy(from.row(y), image.row(y).begin());
}

}  // namespace

node::StepMap chooseSteps(const Communicator& comm, const Camera& camera, double maxError,
                          const DrawWithSteps& draw) {
  const int part = partOf(camera.image);
  const Camera small = smaller(camera, part);
  node::StepMap chosen{camera.image, kTilePixels, 0};
  node::StepMap probe{small.image, kTilePixels / part, kLargestChosenStep};
  Image<Rgba> coarse{comm.isRoot() ? small.image : ImageSize{}};
  copyTo(coarse, draw(small, probe));
  for (double step = kLargestChosenStep;; step /= 2) {
    probeOpenTiles(chosen, step / 2, probe);
    const ImageView<const Rgba> finer = draw(small, probe);
    std::vector<double> change(probe.steps.size());
    if (comm.isRoot()) change = changes(finer, coarse, probe);
    allReduce(comm, std::span{change}, MPI_MAX);
    for (int row = 0; row < chosen.rows(); ++row)
      for (int column = 0; column < chosen.columns; ++column) {
        if (chosen.at(column, row) > 0) continue;
        double largest = 0;
        around(probe, column, row, [&](std::size_t i) { largest = std::max(largest, change[i]); });
        if (kSafety * largest <= maxError) chosen.at(column, row) = step;
      }
    if (std::ranges::find(chosen.steps, 0.0) == chosen.steps.end()) return chosen;
    if (step / 2 <= kSmallestStep) break;
    copyTo(coarse, finer);
  }
  if (comm.isRoot())
    warn("quality.max_error: {} is not reached at {} voxels a step, the smallest", maxError,
         kSmallestStep);
  for (double& tile : chosen.steps) tile = tile > 0 ? tile : kSmallestStep;
  return chosen;
}

}  // namespace burin::host
