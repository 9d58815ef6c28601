#include "gzip_source.hpp"

#include <algorithm>
#include <utility>

#include "burin/common/error.hpp"
#include "byte_order.hpp"

namespace burin::node {
namespace {

/// Refuses a header that promises more voxels than its gzip stream can hold, before anybody makes
/// room for them.
void checkStreamSize(const VolumeInfo& info, const StoredVoxels& stored) {
  // Deflate codes 258 bytes with 2 bits at best: 1032 to 1. The slack leaves streams that are
  // broken or empty to the better messages of the inflater.
  constexpr std::uint64_t kLargestRatio = 1032;
  constexpr std::uint64_t kSlack = std::uint64_t{1} << 16;
  const std::uint64_t fileBytes = regularFileSize(stored.file);
  const std::uint64_t streamBytes = fileBytes - std::min(fileBytes, stored.fileOffset);
  const std::uint64_t expected = stored.streamOffset + info.bytes();
  if (expected <= kSlack || (expected - kSlack) / kLargestRatio <= streamBytes) return;
  fail(ExitCode::kVolume,
       "{}: {} bytes expected for {} x {} x {} voxels of {}, but its {} compressed bytes inflate "
       "to {} at most",
       stored.file.string(), expected, info.grid.dims.x, info.grid.dims.y, info.grid.dims.z,
       voxelTypeName(info.type), streamBytes, kLargestRatio * streamBytes);
}

}  // namespace

GzipSource::GzipSource(VolumeInfo info, const StoredVoxels& stored)
    : info_{(checkStreamSize(info, stored), std::move(info))},
      start_{stored.streamOffset},
      swap_{swapNeeded(stored.bigEndian)},
      stream_{FileHandle{stored.file}, stored.fileOffset} {}

void GzipSource::load(const IndexBox& region, std::span<std::byte> out) {
  checkLoad(info_, region, out);
  if (region.empty()) return;
  const glm::ivec3 size = region.size();
  if (size.x == info_.grid.dims.x && size.y == info_.grid.dims.y) {
    seek(static_cast<std::uint64_t>(region.lo.z) * (out.size() / static_cast<std::size_t>(size.z)));
    read(out);
  } else {
    loadRows(region, out);
  }
  if (swap_) swapBytes(out, bytesPerVoxel(info_.type));
  if (stream_.position() == start_ + info_.bytes()) checkEnd();
}

/// Inflates whole rows of x, one z plane's worth at a time, and picks the region's part of each.
void GzipSource::loadRows(const IndexBox& region, std::span<std::byte> out) {
  const std::size_t voxelBytes = bytesPerVoxel(info_.type);
  const auto rowBytes = static_cast<std::uint64_t>(info_.grid.dims.x) * voxelBytes;
  for (int z = region.lo.z; z < region.hi.z; ++z) {
    const IndexBox rows{{0, region.lo.y, z}, {info_.grid.dims.x, region.hi.y, z + 1}};
    const IndexBox wanted{{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z + 1}};
    scratch_.resize(rows.count() * voxelBytes);
    const auto row = static_cast<std::uint64_t>(z) * static_cast<std::uint64_t>(info_.grid.dims.y) +
                     static_cast<std::uint64_t>(region.lo.y);
    seek(row * rowBytes);
    read(scratch_);
    copyVoxels(scratch_, rows, out, region, wanted, voxelBytes);
  }
}

/// Brings the stream to a byte of the voxels.
void GzipSource::seek(std::uint64_t voxelByte) {
  const std::uint64_t target = start_ + voxelByte;
  if (target < stream_.position()) stream_.restart();
  std::vector<std::byte> skipped;
  while (stream_.position() < target) {
    skipped.resize(static_cast<std::size_t>(
        std::min<std::uint64_t>(target - stream_.position(), std::uint64_t{1} << 20)));
    read(skipped);
  }
}

void GzipSource::read(std::span<std::byte> out) {
  if (stream_.readSome(out) == out.size()) return;
  // A stream of the right check sum but the wrong length: the header does not fit it.
  fail(ExitCode::kVolume, "{}: inflates to {} bytes, {} expected for {} x {} x {} voxels of {}",
       stream_.path().string(), stream_.position(), start_ + info_.bytes(), info_.grid.dims.x,
       info_.grid.dims.y, info_.grid.dims.z, voxelTypeName(info_.type));
}

/// Behind the last voxel: reads on to the stream's own end, so that its check sum counts.
void GzipSource::checkEnd() {
  std::byte more{};
  if (stream_.readSome(std::span{&more, 1}) == 0) return;
  fail(ExitCode::kVolume,
       "{}: inflates to more than the {} bytes expected for {} x {} x {} voxels "
       "of {}",
       stream_.path().string(), start_ + info_.bytes(), info_.grid.dims.x, info_.grid.dims.y,
       info_.grid.dims.z, voxelTypeName(info_.type));
}

}  // namespace burin::node
