#pragma once

#include <span>
#include <string>
#include <vector>

#include "burin/common/geometry.hpp"
#include "stored_type.hpp"

namespace burin::node {

/// What a file holds: `components` numbers of one type per voxel, next to each other.
struct StoredLayout {
  glm::ivec3 dims{1};
  StoredType type = StoredType::kU8;
  int components = 1;

  std::size_t voxelBytes() const {
    return bytesPerNumber(type) * static_cast<std::size_t>(components);
  }
  std::uint64_t bytes() const {
    return static_cast<std::uint64_t>(dims.x) * static_cast<std::uint64_t>(dims.y) *
           static_cast<std::uint64_t>(dims.z) * voxelBytes();
  }
};

/// Voxels as the file holds them, before a component is picked and values are converted. One per
/// rank; nothing here is collective.
class StoredReader {
 public:
  virtual ~StoredReader() = default;
  virtual const StoredLayout& layout() const = 0;

  /// As of BrickSource.
  virtual bool randomAccess() const = 0;

  /// Voxels [region.lo, region.hi), all components, x fastest, native byte order, into `out`
  /// (exactly the region's bytes). Throws Error{kVolume} on truncated or damaged data.
  virtual void read(const IndexBox& region, std::span<std::byte> out) = 0;
};

/// A reader for files that keep their slices apart: any region at the cost of its slices.
class SliceReader : public StoredReader {
 public:
  bool randomAccess() const final { return true; }
  void read(const IndexBox& region, std::span<std::byte> out) final;

 private:
  /// As read, for a box of one slice that is not empty.
  virtual void readSlice(const IndexBox& box, std::span<std::byte> out) = 0;
};

/// A SliceReader whose slices are decoded whole; it keeps the last one, for parts of it are asked
/// for one after another.
class DecodedSlices : public SliceReader {
 private:
  void readSlice(const IndexBox& box, std::span<std::byte> out) final;
  /// Slice `z` into `out`, which has exactly its size.
  virtual void decodeSlice(int z, std::span<std::byte> out) = 0;

  std::vector<std::byte> decoded_;
  int z_ = -1;  ///< of the slice that is decoded
};

/// "7 x 5 x 6 voxels of u8", "... of 3 u8": what messages say was expected.
std::string describe(const StoredLayout& layout);

/// For implementations of StoredReader::read: that `region` lies in the volume and `out` has its
/// size. Throws std::logic_error.
void checkRead(const StoredLayout& layout, const IndexBox& region, std::span<const std::byte> out);

}  // namespace burin::node
