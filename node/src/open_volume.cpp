#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "burin/common/error.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/procedural.hpp"
#include "burin/node/scanned_volume.hpp"
#include "file_formats.hpp"
#include "file_handle.hpp"
#include "gzip_stream.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kStartBytes = 1024;

constexpr std::array<FileFormat, 9> kFormats{{
    {"NRRD", ".nrrd .nhdr", true, recognisesNrrd, openNrrd},
    {"NIfTI", ".nii .nii.gz .hdr/.img", true, recognisesNifti, openNifti},
    {"MetaImage", ".mha .mhd", true, recognisesMetaImage, openMetaImage},
    {"VTK", ".vtk", true, recognisesVtk, openVtk},
    {"VTK XML", ".vti", true, recognisesVti, openVti},
    {"HDF5", ".h5:/PATH", true, recognisesHdf5, openHdf5},
    {"DICOM", ".dcm, a folder", true, recognisesDicom, openDicom, scanDicom, openScannedDicom},
    {"pictures", ".tif, slice%03d.png, a folder", true, recognisesPictures, openPictures},
    {"raw", ".raw .raw.gz", false, recognisesRaw, openRaw},
}};

/// Replaces `bytes` by the inflated first ones, unless that is not what they are: voxels may begin
/// like a gzip stream.
void tryToInflate(const std::filesystem::path& file, std::vector<std::byte>& bytes) {
  try {
    GzipStream stream{FileHandle{file}, 0};
    std::vector<std::byte> inflated(kStartBytes);
    inflated.resize(stream.readSome(inflated));
    bytes = std::move(inflated);
  } catch (const Error&) {
    // A reader that expects gzip says what is wrong with it.
  }
}

FileStart readStart(const VolumeChoice& choice) {
  const std::filesystem::path file{hdf5File(choice.file)};
  FileStart start;
  start.path = file;
  start.hasDims = choice.dims.has_value();
  std::error_code ignored;  // what is no file either, is said below
  start.isFolder = std::filesystem::is_directory(file, ignored);
  const bool hasBytes = !start.isFolder && !isPicturePattern(choice.file);
  if (hasBytes) regularFileSize(file);
  start.lowerName = file.filename().string();
  std::ranges::transform(start.lowerName, start.lowerName.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!hasBytes) return start;
  start.bytes.resize(kStartBytes);
  start.bytes.resize(FileHandle{file}.readSome(0, start.bytes));
  if (start.startsWith("\x1f\x8b")) tryToInflate(file, start.bytes);
  return start;
}

const FileFormat& formatOf(const VolumeChoice& choice) {
  const FileStart start = readStart(choice);
  for (const FileFormat& format : kFormats) {
    if (format.recognises(start)) return format;
  }
  if (start.isFolder) {
    fail(ExitCode::kVolume, "{}: a folder without DICOM images or numbered pictures", choice.file);
  }
  std::string known;
  for (const FileFormat& format : kFormats) {
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.name, format.extensions);
  }
  fail(ExitCode::kVolume, "{}: unknown file format (expected {}; any file with --dims and --type)",
       choice.file, known);
}

/// A source whose header's spacing the user overrides.
class RespacedSource : public BrickSource {
 public:
  RespacedSource(std::unique_ptr<BrickSource> inner, const glm::dvec3& spacing)
      : inner_{std::move(inner)}, info_{inner_->info()} {
    info_.grid.spacing = spacing;
    checkGrid(info_.name, info_.grid, ExitCode::kUsage);
  }
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return inner_->randomAccess(); }
  void load(const IndexBox& region, std::span<std::byte> out) override {
    inner_->load(region, out);
  }

 private:
  std::unique_ptr<BrickSource> inner_;
  VolumeInfo info_;
};

std::unique_ptr<BrickSource> openProcedural(const VolumeChoice& choice) {
  if (!choice.dims) {
    fail(ExitCode::kUsage, "procedural volume \"{}\": dims are missing (expected three numbers)",
         choice.procedural);
  }
  const auto kinds = proceduralKinds();
  const auto kind = std::ranges::find(kinds, choice.procedural, &ProceduralKind::name);
  VoxelType type = kind != kinds.end() && kind->isLabels ? VoxelType::kU8 : VoxelType::kF32;
  if (choice.type) {
    const auto named = voxelTypeFromName(*choice.type);
    if (!named) {
      fail(ExitCode::kUsage, "procedural volume \"{}\": unknown type \"{}\" (expected {})",
           choice.procedural, *choice.type, "u8, i16, u16, f32");
    }
    type = *named;
  }
  return makeProcedural(choice.procedural, *choice.dims, type,
                        choice.spacing.value_or(glm::dvec3{1}));
}

}  // namespace

bool FileStart::startsWith(std::string_view text, std::size_t at) const {
  return bytes.size() >= at + text.size() &&
         std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

std::span<const FileFormat> fileFormats() {
  return kFormats;
}

std::string scanVolume(const VolumeChoice& choice) {
  if (!choice.procedural.empty()) return "";
  const FileFormat& format = formatOf(choice);
  return format.scan == nullptr ? "" : format.scan(choice);
}

std::unique_ptr<BrickSource> openVolume(const VolumeChoice& choice) {
  return openScannedVolume(choice, "");
}

std::unique_ptr<BrickSource> openScannedVolume(const VolumeChoice& choice,
                                               const std::string& scan) {
  if (!choice.procedural.empty()) return openProcedural(choice);
  const FileFormat& format = formatOf(choice);
  if (format.selfDescribing && (choice.dims || choice.type || choice.endian)) {
    fail(ExitCode::kUsage, "{}: dims, type and endian are for bare raw files; {} says them itself",
         choice.file, format.name);
  }
  if (choice.series && format.name != "DICOM") {
    fail(ExitCode::kUsage, "{}: --series is for DICOM folders, and this is {}", choice.file,
         format.name);
  }
  std::unique_ptr<BrickSource> source =
      scan.empty() ? format.open(choice) : format.openScanned(choice, scan);
  if (!choice.spacing) return source;
  return std::make_unique<RespacedSource>(std::move(source), *choice.spacing);
}

}  // namespace burin::node
