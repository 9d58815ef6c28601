#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/node/brick_source.hpp"
#include "stored_source.hpp"

namespace burin::node {

/// A voxel with more numbers is no voxel but a header gone wrong.
inline constexpr int kMostComponents = 1 << 20;

/// Where and how a file keeps its voxels: all that a format's reader has to find out, besides
/// VolumeInfo. The voxels lie x fastest, then y, then z, without gaps.
struct StoredVoxels {
  enum class Encoding { kRaw, kGzip, kZlib, kAscii };

  std::filesystem::path file;  ///< that holds the voxels; not always the one the user named
  /// Raw only: the files of a volume in pieces along z, all of the same length; then `file` is
  /// empty.
  std::vector<std::filesystem::path> pieces;
  Encoding encoding = Encoding::kRaw;
  std::uint64_t fileOffset = 0;    ///< bytes of `file` before the voxels, or before their stream
  std::uint64_t streamOffset = 0;  ///< encoded only: decoded bytes before the first voxel
  bool bigEndian = false;
  StoredType type = StoredType::kU8;
  int components = 1;  ///< per voxel
  /// Components lie one whole volume after another instead of beside each other in each voxel.
  bool isPlanar = false;
  bool exactSize = false;  ///< raw only: nothing may follow the voxels (sizes come from the user)
  Rescale rescale;
};

/// The source for stored voxels, of the component that `choice` says. Sets what follows from them
/// in `info`. Throws Error{kVolume} if a file is missing, is not a regular file, or is too short
/// for its header, and what chosenComponent throws.
std::unique_ptr<BrickSource> openStoredVoxels(VolumeInfo info, const StoredVoxels& stored,
                                              const VolumeChoice& choice);

/// Sizes, x first, as dims. Throws Error{code} unless each is at least 1 and the voxels' bytes can
/// be counted. `code`: kUsage if the user gave them.
glm::ivec3 checkedDims(std::string_view name, const std::int64_t (&sizes)[3],
                       ExitCode code = ExitCode::kVolume);

/// Throws Error{kVolume} unless there is at least one component and all bytes can be counted.
void checkLayout(std::string_view name, const StoredLayout& layout);

/// Throws Error{code} unless spacing is positive and finite and the axes span space.
void checkGrid(std::string_view name, const VolumeGrid& grid, ExitCode code = ExitCode::kVolume);

/// From a grid of points to that of the middles of its cells. An axis of one point stays.
void centreOnCells(VolumeGrid& grid);

/// Throws Error{kVolume} unless the data file that `header` names is a regular file.
void checkDataFile(std::string_view header, const std::filesystem::path& file);

/// A regular file's size in bytes. Throws Error{kVolume} if it is missing or something else.
std::uint64_t regularFileSize(const std::filesystem::path& file);

}  // namespace burin::node
