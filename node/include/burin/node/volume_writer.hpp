#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// The extensions that writeVolume knows, for help texts: ".nrrd .nhdr .nii .nii.gz .raw .raw.gz".
std::string_view writableExtensions();

struct WriteOptions {
  bool gzip = false;  ///< NRRD: gzip encoding. The other formats say it by their extension.
  /// Called after each slab with the part done, in [0, 1]; may throw to stop, then nothing is left.
  std::function<void(double)> progress;
};

/// Local. Writes a source's voxels and grid, in slabs of ascending z and in native byte order, to
/// the format that the extension names: .nrrd (attached header), .nhdr (detached, the voxels in
/// NAME.raw or NAME.raw.gz beside it), .nii, .nii.gz (NIfTI-1), .raw, .raw.gz (voxels alone).
/// Written under temporary names beside their final ones and renamed when whole.
///
/// NIfTI keeps spacing and orientation in single precision, and says "anatomical" of every grid
/// that is more than spacings. Throws Error{kUsage} for an unknown extension, an axis too long for
/// the format, a place that cannot be written or voxels beside a new .nhdr that are not its own,
/// Error{kRank} if the disk fills up or has no room for voxels that are not packed, and what the
/// source throws.
void writeVolume(BrickSource& source, const std::filesystem::path& file,
                 const WriteOptions& options = {});

}  // namespace burin::node
