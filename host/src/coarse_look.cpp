#include "coarse_look.hpp"

#include <algorithm>
#include <cmath>

namespace burin::host {

namespace {

/// Mean extinctions of both materials over all values between two; per world unit.
glm::dvec2 meanExtinctions(const TransferFunction& function, double coreFrom, double lowest,
                           double highest) {
  constexpr int kValues = 8;
  glm::dvec2 sum{0};
  for (int i = 0; i < kValues; ++i) {
    const double value = lowest + (i + 0.5) / kValues * (highest - lowest);
    const double extinction = function.classify(value, *function.opacityUnitLength).extinction;
    sum[value < coreFrom ? 0 : 1] += extinction;
  }
  return sum / double{kValues};
}

int axisOfLargest(const glm::dvec3& v) {
  const glm::dvec3 size = glm::abs(v);
  const int xy = size.x > size.y ? 0 : 1;
  return size[xy] > size.z ? xy : 2;
}

}  // namespace

CoarseLook::CoarseLook(const VolumeGrid& grid, const node::BlockRanges& blocks,
                       const TransferFunction& function, double coreFrom,
                       const glm::dvec3& forwardWorld)
    : blocks_{blocks.blocks} {
  extinctions_.reserve(blocks.lowest.size());
  for (std::size_t i = 0; i < blocks.lowest.size(); ++i) {
    const double lowest = double{blocks.lowest[i]};
    const double highest = double{blocks.highest[i]};
    if (lowest <= highest) {
      const glm::dvec2 mean = meanExtinctions(function, coreFrom, lowest, highest);
      extinctions_.push_back({mean[0], mean[1]});
    } else {
      extinctions_.push_back({});  // nothing finite
    }
  }
  const glm::dvec3 blocksPerUnit =
      grid.worldToIndex() * forwardWorld / static_cast<double>(blocks.blockCells);
  axis_ = axisOfLargest(blocksPerUnit);
  isDescending_ = blocksPerUnit[axis_] < 0;
  layerLength_ = 1 / std::abs(blocksPerUnit[axis_]);
  slope_ =
      glm::dvec2{blocksPerUnit[(axis_ + 1) % 3], blocksPerUnit[(axis_ + 2) % 3]} * layerLength_;
}

CoarseLook::Seen CoarseLook::follow(const glm::dvec2& start, double factor) const {
  Seen seen;
  double clear = 1, clearAlone = 1;
  const int layers = blocks_[axis_];
  const int u = (axis_ + 1) % 3;
  const int v = (axis_ + 2) % 3;
  for (int layer = 0; layer < layers; ++layer) {
    glm::ivec3 block;
    block[axis_] = isDescending_ ? layers - 1 - layer : layer;
    block[u] = static_cast<int>(std::floor(start[0] + slope_[0] * layer + 0.5));
    block[v] = static_cast<int>(std::floor(start[1] + slope_[1] * layer + 0.5));
    if (block[u] < 0 || block[u] >= blocks_[u] || block[v] < 0 || block[v] >= blocks_[v]) continue;
    const std::size_t row =
        static_cast<std::size_t>(block.z) * static_cast<std::size_t>(blocks_.y) +
        static_cast<std::size_t>(block.y);
    const Extinctions& here =
        extinctions_[row * static_cast<std::size_t>(blocks_.x) + static_cast<std::size_t>(block.x)];
    const double skin = factor * here.skin;
    const double all = skin + here.core;
    if (!(all > 0)) continue;
    seen.hasSkin = seen.hasSkin || skin > 0;
    const double light = -clear * std::expm1(-all * layerLength_);
    seen.skin += light * skin / all;
    seen.core += light * here.core / all;
    clear -= light;
    const double lightAlone = -clearAlone * std::expm1(-here.core * layerLength_);
    seen.coreAlone += lightAlone;
    clearAlone -= lightAlone;
  }
  return seen;
}

Visibility CoarseLook::withSkin(double factor) const {
  constexpr double kNothing = 0.02;
  const double last = blocks_[axis_] - 1;
  const glm::dvec2 size{blocks_[(axis_ + 1) % 3], blocks_[(axis_ + 2) % 3]};
  // Every start from which a ray meets the volume somewhere.
  const glm::dvec2 from = glm::floor(glm::min(-slope_ * last, 0.0));
  const glm::dvec2 to = size + glm::ceil(glm::max(-slope_ * last, 0.0));
  double skin = 0, skinRays = 0, core = 0, coreAlone = 0;
  for (double v = from[1]; v < to[1]; ++v)
    for (double u = from[0]; u < to[0]; ++u) {
      const Seen seen = follow({u, v}, factor);
      core += seen.core;
      coreAlone += seen.coreAlone;
      if (!seen.hasSkin || seen.coreAlone > kNothing) continue;
      skin += seen.skin;
      skinRays += 1;
    }
  Visibility visibility;
  if (skinRays > 0) visibility.skin = skin / skinRays;
  if (coreAlone > 0) visibility.core = core / coreAlone;
  return visibility;
}

}  // namespace burin::host
