#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "byte_stream.hpp"
#include "stored_reader.hpp"

namespace burin::node {

/// Where the voxels lie in a stream's bytes.
struct StreamPlace {
  std::uint64_t start = 0;  ///< bytes before the first voxel
  bool bigEndian = false;
  bool moreFollows = false;  ///< bytes behind the last voxel are no mistake
};

/// Voxels in a stream. Regions that span x and y wholly and come in ascending z are decoded once,
/// straight into place; anything behind the stream's position starts it again.
class StreamedVoxels : public StoredReader {
 public:
  /// Throws Error{kVolume} if the layout has more bytes than the stream can hold, before anybody
  /// makes room for them.
  StreamedVoxels(const StoredLayout& layout, std::unique_ptr<ByteStream> stream,
                 const StreamPlace& place);
  const StoredLayout& layout() const override { return layout_; }
  bool randomAccess() const override { return false; }
  void read(const IndexBox& region, std::span<std::byte> out) override;

 private:
  void seek(std::uint64_t voxelByte);
  void fill(std::span<std::byte> out);
  void readRows(const IndexBox& region, std::span<std::byte> out);
  void checkEnd();

  StoredLayout layout_;
  std::unique_ptr<ByteStream> stream_;
  StreamPlace place_;
  std::vector<std::byte> scratch_;
};

}  // namespace burin::node
