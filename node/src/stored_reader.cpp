#include "stored_reader.hpp"

#include "burin/common/error.hpp"

namespace burin::node {

void SliceReader::read(const IndexBox& region, std::span<std::byte> out) {
  checkRead(layout(), region, out);
  if (region.empty()) return;
  const std::size_t sliceBytes = out.size() / static_cast<std::size_t>(region.size().z);
  for (int z = region.lo.z; z < region.hi.z; ++z) {
    const IndexBox slice{{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z + 1}};
    readSlice(slice,
              out.subspan(static_cast<std::size_t>(z - region.lo.z) * sliceBytes, sliceBytes));
  }
}

void DecodedSlices::readSlice(const IndexBox& box, std::span<std::byte> out) {
  const int z = box.lo.z;
  const IndexBox slice{{0, 0, z}, {layout().dims.x, layout().dims.y, z + 1}};
  if (z_ != z) {
    z_ = -1;
    decoded_.resize(slice.count() * layout().voxelBytes());
    decodeSlice(z, decoded_);
    z_ = z;
  }
  copyVoxels(decoded_, slice, out, box, box, layout().voxelBytes());
}

std::string describe(const StoredLayout& layout) {
  const std::string count = layout.components == 1 ? "" : fmt::format("{} ", layout.components);
  return fmt::format("{} x {} x {} voxels of {}{}", layout.dims.x, layout.dims.y, layout.dims.z,
                     count, storedTypeName(layout.type));
}

void checkRead(const StoredLayout& layout, const IndexBox& region, std::span<const std::byte> out) {
  BURIN_CHECK((IndexBox{glm::ivec3{0}, layout.dims}.contains(region)));
  BURIN_CHECK_EQ(out.size(), region.count() * layout.voxelBytes());
}

}  // namespace burin::node
