#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/geometry.hpp"
#include "burin/common/labels.hpp"
#include "burin/common/scene.hpp"

namespace burin::node {

/// Voxel types a source delivers, in native byte order.
enum class VoxelType : std::uint8_t { kU8, kI16, kU16, kF32 };
std::size_t bytesPerVoxel(VoxelType type);
const char* voxelTypeName(VoxelType type);  ///< "u8", "i16", "u16", "f32"
std::optional<VoxelType> voxelTypeFromName(std::string_view name);

struct VolumeInfo {
  std::string name;    ///< in messages: the path as the user gave it, or "procedural vessels"
  std::string format;  ///< "NRRD", "NIfTI", "raw", "procedural", ...
  VolumeGrid grid;
  VoxelType type = VoxelType::kU8;
  bool anatomical = false;  ///< world is LPS
  std::string encoding;     ///< how the file keeps its voxels: "u8, gzip"; "" if there is no file
  int components = 1;       ///< per voxel in the file; one of them is delivered
  std::vector<LabelInfo> labels;  ///< of a segmentation that describes its own (3D Slicer)
  std::string notice;             ///< what the user should know of how it is read, "" if nothing
  std::size_t bytes() const { return grid.voxelCount() * bytesPerVoxel(type); }
};

/// Something that has voxels. One per rank; nothing here is collective.
class BrickSource {
 public:
  virtual ~BrickSource() = default;
  virtual const VolumeInfo& info() const = 0;

  /// True if every rank may load any region at its own cost (uncompressed files, procedural data).
  /// False for a compressed stream: any region can still be loaded, but regions that span x and y
  /// wholly and come in ascending z are the only cheap ones, so one rank reads and scatters.
  virtual bool randomAccess() const = 0;

  /// Voxels [region.lo, region.hi), x fastest, native byte order, into `out` (exactly the region's
  /// bytes). Throws Error{kVolume} on truncated or damaged data, naming the file.
  virtual void load(const IndexBox& region, std::span<std::byte> out) = 0;
};

/// For implementations of BrickSource::load: that `region` lies in the volume and `out` has its
/// size. Throws std::logic_error.
void checkLoad(const VolumeInfo& info, const IndexBox& region, std::span<const std::byte> out);

/// Opens what the scene names: by the file's content and name, or procedural (f32 unless the choice
/// says a type). A spacing in the choice replaces the header's; dims, type and endian are errors
/// for a file that says them itself. Local. Throws Error{kVolume} (bad file) or Error{kUsage}
/// (missing --dims, unknown procedural kind with the nearest name).
std::unique_ptr<BrickSource> openVolume(const VolumeChoice& choice);

/// Rows of a voxel block copied between boxes: `from` (laid out as box `fromBox`) into `to` (laid
/// out as `toBox`), the voxels of `part`, which lies in both.
void copyVoxels(std::span<const std::byte> from, const IndexBox& fromBox, std::span<std::byte> to,
                const IndexBox& toBox, const IndexBox& part, std::size_t bytesPerVoxel);

}  // namespace burin::node
