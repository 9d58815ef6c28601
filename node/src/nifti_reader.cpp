#include <nifti2_io.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

struct FreeImage {
  void operator()(nifti_image* image) const noexcept { nifti_image_free(image); }
};
using ImagePointer = std::unique_ptr<nifti_image, FreeImage>;

/// Magic words of the two versions and where they stand: a single file, and a header with its
/// voxels in a file of their own.
bool hasMagic(const FileStart& start) {
  using std::string_view_literals::operator""sv;
  constexpr std::size_t kAt1 = 344;
  constexpr std::size_t kAt2 = 4;
  return start.startsWith("n+1\0"sv, kAt1) || start.startsWith("ni1\0"sv, kAt1) ||
         start.startsWith("n+2\0"sv, kAt2) || start.startsWith("ni2\0"sv, kAt2);
}

/// The header that goes with the file the user named: of "head.img" it is "head.hdr".
std::string headerName(const std::string& file) {
  fs::path path{file};
  if (path.extension() == ".img") path.replace_extension(".hdr");
  return path.string();
}

/// The library looks for header and image under these names by opening them, which waits for ever
/// if one is a FIFO. Throws if one is neither a file nor a folder.
void checkCandidates(const fs::path& file) {
  constexpr const char* kExtensions[] = {".hdr", ".img", ".nii", ".HDR", ".IMG", ".NII"};
  fs::path base = file;
  if (base.extension() == ".gz" || base.extension() == ".GZ") base.replace_extension();
  if (std::ranges::find(kExtensions, base.extension()) != std::end(kExtensions))
    base.replace_extension();
  for (const char* extension : kExtensions) {
    for (const char* packed : {"", ".gz", ".GZ"}) {
      const fs::path candidate = base.string() + extension + packed;
      std::error_code said;  // by what follows, of links that lead nowhere
      const fs::file_type type = fs::status(candidate, said).type();
      if (type != fs::file_type::not_found && type != fs::file_type::directory)
        regularFileSize(candidate);
    }
  }
}

/// What the library would say about on stderr whatever it is told. `header`: nifti_1_header or
/// nifti_2_header.
template <typename Header>
void checkHeader(const std::string& file, const Header& header) {
  const auto dims = std::span{header.dim}.subspan(1);
  if (header.dim[0] < 1 || header.dim[0] > 7 ||
      std::ranges::any_of(dims.first(static_cast<std::size_t>(header.dim[0])),
                          [](auto dim) { return dim < 1; })) {
    fail(ExitCode::kVolume, "{}: dim is {} (expected 1 to 7 dimensions of at least 1 each)", file,
         fmt::join(header.dim, " "));
  }
  if (header.datatype <= DT_BINARY || nifti_is_valid_datatype(header.datatype) == 0) {
    fail(ExitCode::kVolume, "{}: voxel type {} is not supported (expected {})", file,
         header.datatype, supportedTypeNames());
  }
}

template <typename Header>
void checkOwned(const std::string& file, Header* header) {
  const std::unique_ptr<Header, decltype(&std::free)> owned{header, &std::free};
  if (owned == nullptr) fail(ExitCode::kVolume, "{}: not a valid NIfTI header", file);
  checkHeader(file, *owned);
}

/// 1 or 2; 0 of older headers (ANALYZE), which are laid out as those of version 1. -1: no header,
/// or not a whole one.
int headerVersion(const std::string& name) {
  nifti_2_header start{};  // the longer one
  znzFile file = znzopen(name.c_str(), "rb", nifti_is_gzfile(name.c_str()));
  if (znz_isnull(file)) return -1;
  const std::size_t bytes = znzread(&start, 1, sizeof start, file);
  znzclose(file);
  const int version = nifti_header_version(reinterpret_cast<const char*>(&start), bytes);
  return version == 2 && bytes < sizeof start ? -1 : version;
}

/// In the bytes' own order: only the readers of one version turn them.
void checkHeader(const std::string& file) {
  const std::string name = headerName(file);
  const int version = headerVersion(name);
  int isSwapped = 0;
  if (version == 2)
    checkOwned(file, nifti_read_n2_hdr(name.c_str(), &isSwapped, 0));
  else if (version >= 0)
    checkOwned(file, nifti_read_n1_hdr(name.c_str(), &isSwapped, 0));
  else
    fail(ExitCode::kVolume, "{}: not a valid NIfTI header", file);
}

ImagePointer readHeader(const std::string& file) {
  regularFileSize(headerName(file));
  checkCandidates(file);
  nifti_set_debug_level(0);  // its messages go to stderr; ours say what it would
  checkHeader(file);
  ImagePointer image{nifti_image_read(headerName(file).c_str(), 0)};
  if (image == nullptr) fail(ExitCode::kVolume, "{}: not a valid NIfTI header", file);
  return image;
}

glm::ivec3 dimsOf(const std::string& name, const nifti_image& image) {
  if (image.nt > 1 || image.nv > 1 || image.nw > 1) {
    fail(ExitCode::kVolume,
         "{}: {} dimensions ({} x {} x {} x {} x {} ...; expected a volume with "
         "3)",
         name, image.ndim, image.nx, image.ny, image.nz, image.nt, image.nu);
  }
  return checkedDims(name, {image.nx, image.ny, image.nz});
}

struct VoxelFormat {
  int niftiType;
  StoredType type;
  int components;
};

constexpr VoxelFormat kVoxelFormats[] = {
    {NIFTI_TYPE_UINT8, StoredType::kU8, 1},      {NIFTI_TYPE_INT8, StoredType::kI8, 1},
    {NIFTI_TYPE_UINT16, StoredType::kU16, 1},    {NIFTI_TYPE_INT16, StoredType::kI16, 1},
    {NIFTI_TYPE_UINT32, StoredType::kU32, 1},    {NIFTI_TYPE_INT32, StoredType::kI32, 1},
    {NIFTI_TYPE_UINT64, StoredType::kU64, 1},    {NIFTI_TYPE_INT64, StoredType::kI64, 1},
    {NIFTI_TYPE_FLOAT32, StoredType::kF32, 1},   {NIFTI_TYPE_FLOAT64, StoredType::kF64, 1},
    {NIFTI_TYPE_RGB24, StoredType::kU8, 3},      {NIFTI_TYPE_RGBA32, StoredType::kU8, 4},
    {NIFTI_TYPE_COMPLEX64, StoredType::kF32, 2}, {NIFTI_TYPE_COMPLEX128, StoredType::kF64, 2}};

const VoxelFormat& formatOf(const std::string& name, const nifti_image& image) {
  for (const VoxelFormat& format : kVoxelFormats) {
    if (format.niftiType == image.datatype) return format;
  }
  fail(ExitCode::kVolume, "{}: voxel type \"{}\" is not supported (expected {})", name,
       nifti_datatype_string(image.datatype), supportedTypeNames());
}

/// The index-to-world matrix the file gives, in its own space (RAS): the sform, else the qform.
/// Nothing if it gives neither: then, says the standard, "no particular spatial orientation".
const nifti_dmat44* worldMatrix(const nifti_image& image) {
  if (image.sform_code > 0) return &image.sto_xyz;
  if (image.qform_code > 0) return &image.qto_xyz;
  return nullptr;
}

void setOrientation(const nifti_image& image, VolumeInfo& info) {
  const nifti_dmat44* toRas = worldMatrix(image);
  info.anatomical = toRas != nullptr;
  if (toRas == nullptr) {
    info.grid.spacing = {std::abs(image.dx), std::abs(image.dy), std::abs(image.dz)};
    return;
  }
  const glm::dvec3 turn{-1, -1, 1};  // RAS to LPS
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 step{toRas->m[0][axis], toRas->m[1][axis], toRas->m[2][axis]};
    info.grid.spacing[axis] = glm::length(step);
    info.grid.direction[axis] = turn * step / info.grid.spacing[axis];
  }
  info.grid.origin = turn * glm::dvec3{toRas->m[0][3], toRas->m[1][3], toRas->m[2][3]};
}

StoredVoxels storedVoxels(const std::string& name, const nifti_image& image) {
  std::error_code ignored;
  if (image.iname == nullptr || !fs::exists(image.iname, ignored)) {
    fail(ExitCode::kVolume, "{}: the file with the voxels is missing (expected {})", name,
         image.iname == nullptr ? "an .img beside the header" : image.iname);
  }
  if (image.iname_offset < 0) {
    fail(ExitCode::kVolume, "{}: voxel offset {} (expected at least 0)", name, image.iname_offset);
  }
  StoredVoxels stored;
  stored.file = image.iname;
  const VoxelFormat& format = formatOf(name, image);
  stored.type = format.type;
  stored.components = format.components;
  if (image.nu > 1) {  // the fifth dimension: vectors, one volume for each of their components
    if (format.components > 1 || image.nu > kMostComponents) {
      fail(ExitCode::kVolume, "{}: {} vectors of {} (expected at most {} scalars)", name, image.nu,
           nifti_datatype_string(image.datatype), kMostComponents);
    }
    stored.components = static_cast<int>(image.nu);
    stored.isPlanar = true;
  }
  const bool native = image.byteorder == nifti_short_order();
  stored.bigEndian = native == (std::endian::native == std::endian::big);
  const auto offset = static_cast<std::uint64_t>(image.iname_offset);
  if (nifti_is_gzfile(image.iname) != 0) {
    stored.encoding = StoredVoxels::Encoding::kGzip;
    stored.streamOffset = offset;
  } else {
    stored.fileOffset = offset;
  }
  // NIfTI: a slope of 0 says that there is no scaling.
  if (image.scl_slope != 0 && std::isfinite(image.scl_slope) && std::isfinite(image.scl_inter)) {
    stored.rescale = {image.scl_slope, image.scl_inter};
  }
  return stored;
}

}  // namespace

bool recognisesNifti(const FileStart& start) {
  return hasMagic(start) || start.nameEndsWith(".nii") || start.nameEndsWith(".nii.gz") ||
         start.nameEndsWith(".hdr") || start.nameEndsWith(".img");
}

std::unique_ptr<BrickSource> openNifti(const VolumeChoice& choice) {
  const ImagePointer image = readHeader(choice.file);
  VolumeInfo info;
  info.name = choice.file;
  info.format = "NIfTI";
  info.grid.dims = dimsOf(choice.file, *image);
  setOrientation(*image, info);
  checkGrid(choice.file, info.grid);
  return openStoredVoxels(std::move(info), storedVoxels(choice.file, *image), choice);
}

}  // namespace burin::node
