#include "streamed_voxels.hpp"

#include <algorithm>
#include <utility>

#include "burin/common/error.hpp"
#include "byte_order.hpp"

namespace burin::node {

StreamedVoxels::StreamedVoxels(const StoredLayout& layout, std::unique_ptr<ByteStream> stream,
                               const StreamPlace& place)
    : layout_{layout}, stream_{std::move(stream)}, place_{place} {
  const std::uint64_t expected = place_.start + layout_.bytes();
  if (expected <= stream_->mostBytes()) return;
  fail(ExitCode::kVolume,
       "{}: {} bytes expected for {}, but what the file holds of them decodes to {} at most",
       stream_->path().string(), expected, describe(layout_), stream_->mostBytes());
}

void StreamedVoxels::read(const IndexBox& region, std::span<std::byte> out) {
  checkRead(layout_, region, out);
  if (region.empty()) return;
  const glm::ivec3 size = region.size();
  if (size.x == layout_.dims.x && size.y == layout_.dims.y) {
    seek(static_cast<std::uint64_t>(region.lo.z) * (out.size() / static_cast<std::size_t>(size.z)));
    fill(out);
  } else {
    readRows(region, out);
  }
  if (swapNeeded(place_.bigEndian)) swapBytes(out, bytesPerNumber(layout_.type));
  if (!place_.moreFollows && stream_->position() == place_.start + layout_.bytes()) checkEnd();
}

/// Decodes whole rows of x, one z plane's worth at a time, and picks the region's part of each.
void StreamedVoxels::readRows(const IndexBox& region, std::span<std::byte> out) {
  const std::size_t voxelBytes = layout_.voxelBytes();
  const auto rowBytes = static_cast<std::uint64_t>(layout_.dims.x) * voxelBytes;
  for (int z = region.lo.z; z < region.hi.z; ++z) {
    const IndexBox rows{{0, region.lo.y, z}, {layout_.dims.x, region.hi.y, z + 1}};
    const IndexBox wanted{{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z + 1}};
    scratch_.resize(rows.count() * voxelBytes);
    const auto row = static_cast<std::uint64_t>(z) * static_cast<std::uint64_t>(layout_.dims.y) +
                     static_cast<std::uint64_t>(region.lo.y);
    seek(row * rowBytes);
    fill(scratch_);
    copyVoxels(scratch_, rows, out, region, wanted, voxelBytes);
  }
}

/// Brings the stream to a byte of the voxels.
void StreamedVoxels::seek(std::uint64_t voxelByte) {
  const std::uint64_t target = place_.start + voxelByte;
  if (target < stream_->position()) stream_->restart();
  std::vector<std::byte> skipped;
  while (stream_->position() < target) {
    skipped.resize(static_cast<std::size_t>(
        std::min<std::uint64_t>(target - stream_->position(), std::uint64_t{1} << 20)));
    fill(skipped);
  }
}

void StreamedVoxels::fill(std::span<std::byte> out) {
  if (stream_->readSome(out) == out.size()) return;
  // A stream of the right check sum but the wrong length: the header does not fit it.
  fail(ExitCode::kVolume, "{}: inflates to {} bytes, {} expected for {}", stream_->path().string(),
       stream_->position(), place_.start + layout_.bytes(), describe(layout_));
}

/// Behind the last voxel: reads on to the stream's own end, so that its check sum counts.
void StreamedVoxels::checkEnd() {
  std::byte more{};
  if (stream_->readSome(std::span{&more, 1}) == 0) return;
  fail(ExitCode::kVolume, "{}: inflates to more than the {} bytes expected for {}",
       stream_->path().string(), place_.start + layout_.bytes(), describe(layout_));
}

}  // namespace burin::node
