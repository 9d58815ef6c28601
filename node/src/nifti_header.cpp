#include <nifti2_io.h>

#include <cstring>
#include <limits>

#include "burin/common/error.hpp"
#include "volume_headers.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kVoxelsAt = 352;  // the header's 348 bytes and four that say "no extension"

short niftiType(VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return NIFTI_TYPE_UINT8;
    case VoxelType::kI16:
      return NIFTI_TYPE_INT16;
    case VoxelType::kU16:
      return NIFTI_TYPE_UINT16;
    case VoxelType::kF32:
      return NIFTI_TYPE_FLOAT32;
  }
  throw std::logic_error{"voxel type out of range"};
}

/// The sform: index to RAS, three rows.
void setOrientation(const VolumeInfo& info, nifti_1_header& header) {
  if (isPlainGrid(info.grid) && !info.anatomical) return;  // pixdim says it all
  header.sform_code = NIFTI_XFORM_SCANNER_ANAT;
  const glm::dmat3 toWorld = info.grid.indexToWorld();
  const glm::dvec3 turn{-1, -1, 1};  // LPS to RAS
  float* rows[3] = {header.srow_x, header.srow_y, header.srow_z};
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      rows[row][axis] = static_cast<float>(turn[row] * toWorld[axis][row]);
    }
    rows[row][3] = static_cast<float>(turn[row] * info.grid.origin[row]);
  }
}

}  // namespace

std::vector<std::byte> niftiHeader(const VolumeInfo& info, std::string_view name) {
  nifti_1_header header{};
  header.sizeof_hdr = sizeof header;
  header.regular = 'r';
  header.dim[0] = 3;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr int kLongest = std::numeric_limits<short>::max();
    if (info.grid.dims[axis] > kLongest) {
      fail(ExitCode::kUsage, "{}: {} voxels along axis {} (NIfTI-1 holds at most {})", name,
           info.grid.dims[axis], axis, kLongest);
    }
    header.dim[axis + 1] = static_cast<short>(info.grid.dims[axis]);
    header.pixdim[axis + 1] = static_cast<float>(info.grid.spacing[axis]);
  }
  for (int axis = 4; axis < 8; ++axis) header.dim[axis] = 1;
  header.pixdim[0] = 1;
  header.datatype = niftiType(info.type);
  header.bitpix = static_cast<short>(8 * bytesPerVoxel(info.type));
  header.vox_offset = static_cast<float>(kVoxelsAt);
  header.xyzt_units = info.anatomical ? NIFTI_UNITS_MM : NIFTI_UNITS_UNKNOWN;
  std::memcpy(header.magic, "n+1", 4);
  setOrientation(info, header);
  std::vector<std::byte> bytes(kVoxelsAt);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

}  // namespace burin::node
