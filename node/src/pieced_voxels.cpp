#include "pieced_voxels.hpp"

#include <algorithm>
#include <utility>

#include "burin/common/error.hpp"

namespace burin::node {

PiecedVoxels::PiecedVoxels(const StoredLayout& layout, std::vector<std::filesystem::path> files,
                           std::uint64_t start, bool bigEndian)
    : layout_{layout},
      pieceLayout_{layout},
      files_{std::move(files)},
      start_{start},
      bigEndian_{bigEndian} {
  BURIN_CHECK(!files_.empty());
  const auto slices = static_cast<std::size_t>(layout.dims.z);
  if (slices % files_.size() != 0) {
    fail(ExitCode::kVolume, "{} ...: {} data files for {} slices (expected one for each)",
         files_.front().string(), files_.size(), slices);
  }
  pieceLayout_.dims.z = static_cast<int>(slices / files_.size());
  for (std::size_t i = 0; i < files_.size(); ++i) piece(i);
}

RawVoxels& PiecedVoxels::piece(std::size_t index) {
  if (open_ == nullptr || openIndex_ != index) {
    open_ = std::make_unique<RawVoxels>(pieceLayout_, files_[index], start_, bigEndian_, false);
    openIndex_ = index;
  }
  return *open_;
}

void PiecedVoxels::read(const IndexBox& region, std::span<std::byte> out) {
  checkRead(layout_, region, out);
  if (region.empty()) return;
  const std::size_t sliceBytes = out.size() / static_cast<std::size_t>(region.size().z);
  const int thickness = pieceLayout_.dims.z;
  for (int z = region.lo.z; z < region.hi.z;) {
    const int index = z / thickness;
    const int end = std::min(region.hi.z, (index + 1) * thickness);
    const IndexBox part{{region.lo.x, region.lo.y, z - index * thickness},
                        {region.hi.x, region.hi.y, end - index * thickness}};
    piece(static_cast<std::size_t>(index))
        .read(part, out.subspan(static_cast<std::size_t>(z - region.lo.z) * sliceBytes,
                                static_cast<std::size_t>(end - z) * sliceBytes));
    z = end;
  }
}

}  // namespace burin::node
