#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "burin/common/error.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::node {

/// Where and how a file keeps its voxels: all that a format's reader has to find out, besides
/// VolumeInfo. The voxels lie x fastest, then y, then z, without gaps.
struct StoredVoxels {
  enum class Encoding { kRaw, kGzip };

  std::filesystem::path file;  ///< that holds the voxels; not always the one the user named
  Encoding encoding = Encoding::kRaw;
  std::uint64_t fileOffset = 0;    ///< bytes of `file` before the voxels, or before the gzip stream
  std::uint64_t streamOffset = 0;  ///< gzip only: inflated bytes before the first voxel
  bool bigEndian = false;
  VoxelType type = VoxelType::kU8;  ///< as stored
  bool exactSize = false;  ///< raw only: nothing may follow the voxels (sizes come from the user)

  /// Data units = stored * slope + intercept; delivered as f32 unless slope is 1 and intercept 0.
  double slope = 1;
  double intercept = 0;
};

/// The source for stored voxels. Sets info.type. Throws Error{kVolume} if the file is missing, is
/// not a regular file, or is too short for its header.
std::unique_ptr<BrickSource> openStoredVoxels(VolumeInfo info, const StoredVoxels& stored);

/// "u8, i16, u16, f32": what messages list as supported.
std::string_view supportedTypeNames();

/// Sizes, x first, as dims. Throws Error{code} unless each is at least 1 and the voxels' bytes can
/// be counted. `code`: kUsage if the user gave them.
glm::ivec3 checkedDims(std::string_view name, const std::int64_t (&sizes)[3],
                       ExitCode code = ExitCode::kVolume);

/// Throws Error{code} unless spacing is positive and finite and the axes span space.
void checkGrid(std::string_view name, const VolumeGrid& grid, ExitCode code = ExitCode::kVolume);

/// A regular file's size in bytes. Throws Error{kVolume} if it is missing or something else.
std::uint64_t regularFileSize(const std::filesystem::path& file);

}  // namespace burin::node
