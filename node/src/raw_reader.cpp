#include <bit>
#include <filesystem>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "raw_name.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

glm::ivec3 rawDims(const VolumeChoice& choice, const std::optional<RawName>& name) {
  if (!choice.dims && !name) {
    fail(ExitCode::kUsage,
         "{}: a bare raw file needs dims and type (--dims X,Y,Z --type T), or a name like "
         "name_256x256x128_uint8.raw",
         choice.file);
  }
  const glm::ivec3 dims = choice.dims ? *choice.dims : name->dims;
  return checkedDims(choice.file, {dims.x, dims.y, dims.z},
                     choice.dims ? ExitCode::kUsage : ExitCode::kVolume);
}

StoredType rawType(const VolumeChoice& choice, const std::optional<RawName>& name) {
  if (!choice.type && !name) {
    fail(ExitCode::kUsage, "{}: a bare raw file needs a type (expected --type {})", choice.file,
         supportedTypeNames());
  }
  const std::string& written = choice.type ? *choice.type : name->type;
  if (const auto known = canonicalTypeName(written)) return *storedTypeFromName(*known);
  fail(choice.type ? ExitCode::kUsage : ExitCode::kVolume,
       "{}: voxel type \"{}\" is not supported (expected {})", choice.file, written,
       supportedTypeNames());
}

bool rawBigEndian(const VolumeChoice& choice) {
  const std::string endian = choice.endian.value_or("little");
  if (endian != "little" && endian != "big") {
    fail(ExitCode::kUsage, "{}: endian \"{}\" (expected little or big)", choice.file, endian);
  }
  return endian == "big";
}

}  // namespace

bool recognisesRaw(const FileStart& start) {
  return start.hasDims || start.nameEndsWith(".raw") || start.nameEndsWith(".raw.gz");
}

std::unique_ptr<BrickSource> openRaw(const VolumeChoice& choice) {
  const std::filesystem::path file{choice.file};
  const auto name = parseRawName(file.filename().string());
  VolumeInfo info;
  info.name = choice.file;
  info.format = "raw";
  info.grid.dims = rawDims(choice, name);
  StoredVoxels stored;
  stored.file = file;
  stored.type = rawType(choice, name);
  stored.bigEndian = rawBigEndian(choice);
  stored.encoding =
      file.extension() == ".gz" ? StoredVoxels::Encoding::kGzip : StoredVoxels::Encoding::kRaw;
  stored.exactSize = true;
  return openStoredVoxels(std::move(info), stored, choice);
}

}  // namespace burin::node
