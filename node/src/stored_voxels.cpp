#include "stored_voxels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "burin/common/error.hpp"
#include "gzip_source.hpp"
#include "raw_source.hpp"
#include "scaled_source.hpp"

namespace burin::node {

namespace fs = std::filesystem;

std::string_view supportedTypeNames() {
  return "u8, i16, u16, f32";
}

std::uint64_t regularFileSize(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    fail(ExitCode::kVolume, "{}: no such file", file.string());
  }
  if (error) fail(ExitCode::kVolume, "{}: {}", file.string(), error.message());
  if (status.type() != fs::file_type::regular) {
    fail(ExitCode::kVolume, "{}: not a regular file (expected a file of voxels)", file.string());
  }
  const std::uint64_t size = fs::file_size(file, error);
  if (error) fail(ExitCode::kVolume, "{}: {}", file.string(), error.message());
  return size;
}

glm::ivec3 checkedDims(std::string_view name, const std::int64_t (&sizes)[3], ExitCode code) {
  // Eight bytes per voxel at most, so that no byte count of ours can overflow 63 bits.
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max() / 8;
  std::int64_t voxels = 1;
  for (const std::int64_t size : sizes) {
    if (size < 1 || size > std::numeric_limits<int>::max() - 1) {
      fail(code, "{}: dimensions {} x {} x {} (expected each in 1 ... 2147483646)", name, sizes[0],
           sizes[1], sizes[2]);
    }
    if (voxels > kLargest / size) {
      fail(code, "{}: dimensions {} x {} x {} are more voxels than can be addressed", name,
           sizes[0], sizes[1], sizes[2]);
    }
    voxels *= size;
  }
  return {static_cast<int>(sizes[0]), static_cast<int>(sizes[1]), static_cast<int>(sizes[2])};
}

void checkGrid(std::string_view name, const VolumeGrid& grid, ExitCode code) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(grid.spacing[axis] > 0) || !std::isfinite(grid.spacing[axis])) {
      fail(code, "{}: spacing {} along axis {} (expected a positive number)", name,
           grid.spacing[axis], axis);
    }
    if (!std::isfinite(grid.origin[axis])) {
      fail(code, "{}: origin coordinate {} is not finite", name, axis);
    }
  }
  // Columns are unit vectors: 1e-6 is a hundredth of what a float header could still say by intent.
  const double volume = glm::determinant(grid.direction);
  if (!(std::abs(volume) > 1e-6)) {
    fail(code, "{}: the axis directions lie in one plane (determinant {})", name, volume);
  }
}

std::unique_ptr<BrickSource> openStoredVoxels(VolumeInfo info, const StoredVoxels& stored) {
  const bool scaled = stored.slope != 1 || stored.intercept != 0;
  info.type = stored.type;
  if (scaled) {
    info.notice =
        fmt::format("{}: {} voxels delivered as f32 (value = stored * {} + {})", info.name,
                    voxelTypeName(stored.type), stored.slope, stored.intercept);
  }
  std::unique_ptr<BrickSource> source;
  if (stored.encoding == StoredVoxels::Encoding::kGzip) {
    source = std::make_unique<GzipSource>(std::move(info), stored);
  } else {
    source = std::make_unique<RawSource>(std::move(info), stored);
  }
  if (!scaled) return source;
  return std::make_unique<ScaledSource>(std::move(source), stored.slope, stored.intercept);
}

}  // namespace burin::node
