#pragma once

#include <cstdint>
#include <vector>

#include "burin/node/brick_source.hpp"
#include "gzip_stream.hpp"
#include "stored_voxels.hpp"

namespace burin::node {

/// Voxels in a gzip stream. Regions that span x and y wholly and come in ascending z are inflated
/// once, straight into place; anything behind the stream's position starts it again.
class GzipSource : public BrickSource {
 public:
  GzipSource(VolumeInfo info, const StoredVoxels& stored);
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return false; }
  void load(const IndexBox& region, std::span<std::byte> out) override;

 private:
  void seek(std::uint64_t voxelByte);
  void read(std::span<std::byte> out);
  void loadRows(const IndexBox& region, std::span<std::byte> out);
  void checkEnd();

  VolumeInfo info_;
  std::uint64_t start_;  ///< inflated bytes before the first voxel
  bool swap_;
  GzipStream stream_;
  std::vector<std::byte> scratch_;
};

}  // namespace burin::node
