#include "raw_voxels.hpp"

#include "burin/common/error.hpp"
#include "byte_order.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// `file`, if it is long enough.
const std::filesystem::path& checkedSize(const StoredLayout& layout,
                                         const std::filesystem::path& file, std::uint64_t start,
                                         bool exactSize) {
  const std::uint64_t found = regularFileSize(file);
  const std::uint64_t expected = start + layout.bytes();
  if (found < expected) {
    fail(ExitCode::kVolume, "{}: truncated: {} bytes found, {} expected ({} before the voxels, {})",
         file.string(), found, expected, start, describe(layout));
  }
  if (exactSize && found > expected) {
    fail(ExitCode::kVolume, "{}: {} bytes found, {} expected for {}", file.string(), found,
         expected, describe(layout));
  }
  return file;
}

}  // namespace

RawVoxels::RawVoxels(const StoredLayout& layout, const std::filesystem::path& file,
                     std::uint64_t start, bool bigEndian, bool exactSize)
    : layout_{layout},
      file_{checkedSize(layout, file, start, exactSize)},
      start_{start},
      swap_{swapNeeded(bigEndian)} {}

std::uint64_t RawVoxels::byteOffset(int x, int y, int z) const {
  const auto row = static_cast<std::uint64_t>(z) * static_cast<std::uint64_t>(layout_.dims.y) +
                   static_cast<std::uint64_t>(y);
  const auto voxel =
      row * static_cast<std::uint64_t>(layout_.dims.x) + static_cast<std::uint64_t>(x);
  return start_ + voxel * layout_.voxelBytes();
}

void RawVoxels::read(const IndexBox& region, std::span<std::byte> out) {
  checkRead(layout_, region, out);
  if (region.empty()) return;
  const glm::ivec3 size = region.size();
  if (size.x == layout_.dims.x && size.y == layout_.dims.y) {
    file_.readExactly(byteOffset(0, 0, region.lo.z), out);
  } else {
    const std::size_t planeBytes = out.size() / static_cast<std::size_t>(size.z);
    for (int z = region.lo.z; z < region.hi.z; ++z) {
      const auto plane = static_cast<std::size_t>(z - region.lo.z);
      readPlane(region, z, out.subspan(plane * planeBytes, planeBytes));
    }
  }
  if (swap_) swapBytes(out, bytesPerNumber(layout_.type));
}

/// One z plane of the region. Rows that make up at least an eighth of the bytes between the first
/// and the last are read in one go: a system call costs as much as reading some KiB.
void RawVoxels::readPlane(const IndexBox& region, int z, std::span<std::byte> out) {
  constexpr std::size_t kWorthwhile = 8;
  const std::size_t rowBytes = static_cast<std::size_t>(region.size().x) * layout_.voxelBytes();
  const std::size_t stride = static_cast<std::size_t>(layout_.dims.x) * layout_.voxelBytes();
  const std::uint64_t first = byteOffset(region.lo.x, region.lo.y, z);
  if (rowBytes == stride) {
    file_.readExactly(first, out);
  } else if (stride / kWorthwhile <= rowBytes) {
    file_.readPieces(first, rowBytes, stride, out);
  } else {
    for (std::size_t done = 0; done < out.size(); done += rowBytes)
      file_.readExactly(first + done / rowBytes * stride, out.subspan(done, rowBytes));
  }
}

}  // namespace burin::node
