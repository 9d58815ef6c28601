#pragma once

#include <memory>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// Another source's voxels times slope plus intercept, as f32 (computed in double).
class ScaledSource : public BrickSource {
 public:
  ScaledSource(std::unique_ptr<BrickSource> stored, double slope, double intercept);
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return stored_->randomAccess(); }
  void load(const IndexBox& region, std::span<std::byte> out) override;

 private:
  std::unique_ptr<BrickSource> stored_;
  VolumeInfo info_;
  double slope_;
  double intercept_;
  std::vector<std::byte> scratch_;
};

}  // namespace burin::node
