#pragma once

#include <memory>
#include <vector>

#include "raw_voxels.hpp"

namespace burin::node {

/// Uncompressed voxels in several files, each with the same number of slices.
class PiecedVoxels : public StoredReader {
 public:
  /// In each file the voxels begin at byte `start`. Checks the files' sizes. Throws Error{kVolume},
  /// also if the slices cannot be shared out evenly.
  PiecedVoxels(const StoredLayout& layout, std::vector<std::filesystem::path> files,
               std::uint64_t start, bool bigEndian);
  const StoredLayout& layout() const override { return layout_; }
  bool randomAccess() const override { return true; }
  void read(const IndexBox& region, std::span<std::byte> out) override;

 private:
  RawVoxels& piece(std::size_t index);

  StoredLayout layout_;
  StoredLayout pieceLayout_;
  std::vector<std::filesystem::path> files_;
  std::uint64_t start_;
  bool bigEndian_;
  std::size_t openIndex_ = 0;        ///< of the piece that is open:
  std::unique_ptr<RawVoxels> open_;  ///< one only, as a process may have 1024 files
};

}  // namespace burin::node
