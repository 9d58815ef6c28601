#pragma once

#include <cstdint>

#include "file_handle.hpp"
#include "stored_reader.hpp"

namespace burin::node {

/// Uncompressed voxels, read straight from the file: any region at its own cost.
class RawVoxels : public StoredReader {
 public:
  /// The voxels begin at byte `start`. Checks the file's size; `exactSize`: nothing may follow
  /// them.
  RawVoxels(const StoredLayout& layout, const std::filesystem::path& file, std::uint64_t start,
            bool bigEndian, bool exactSize);
  const StoredLayout& layout() const override { return layout_; }
  bool randomAccess() const override { return true; }
  void read(const IndexBox& region, std::span<std::byte> out) override;

 private:
  void readPlane(const IndexBox& region, int z, std::span<std::byte> out);
  std::uint64_t byteOffset(int x, int y, int z) const;

  StoredLayout layout_;
  FileHandle file_;
  std::uint64_t start_;
  bool swap_;
};

}  // namespace burin::node
