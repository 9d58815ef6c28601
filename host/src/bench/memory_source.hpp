#pragma once

#include <memory>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::host::bench {

/// A volume whose voxels are all in memory: made once, loaded by any number of workers.
class MemorySource : public node::BrickSource {
 public:
  /// `voxels`: info.bytes() of them, x fastest, native byte order.
  MemorySource(node::VolumeInfo info, std::vector<std::byte> voxels);
  const node::VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return true; }
  void load(const IndexBox& region, std::span<std::byte> out) override;

 private:
  node::VolumeInfo info_;
  std::vector<std::byte> voxels_;
};

/// Local. Another source's voxels, read at once.
std::unique_ptr<node::BrickSource> inMemory(node::BrickSource& source);

}  // namespace burin::host::bench
