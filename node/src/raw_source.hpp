#pragma once

#include <cstdint>
#include <vector>

#include "burin/node/brick_source.hpp"
#include "file_handle.hpp"
#include "stored_voxels.hpp"

namespace burin::node {

/// Uncompressed voxels, read straight from the file: any region at its own cost.
class RawSource : public BrickSource {
 public:
  /// Checks the file's size against the header.
  RawSource(VolumeInfo info, const StoredVoxels& stored);
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return true; }
  void load(const IndexBox& region, std::span<std::byte> out) override;

 private:
  void readPlane(const IndexBox& region, int z, std::span<std::byte> out);
  std::uint64_t byteOffset(int x, int y, int z) const;

  VolumeInfo info_;
  FileHandle file_;
  std::uint64_t start_;
  bool swap_;
  std::vector<std::byte> scratch_;
};

}  // namespace burin::node
