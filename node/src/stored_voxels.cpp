#include "stored_voxels.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "burin/common/error.hpp"
#include "gzip_stream.hpp"
#include "pieced_voxels.hpp"
#include "raw_voxels.hpp"
#include "streamed_voxels.hpp"
#include "text_stream.hpp"

namespace burin::node {

namespace fs = std::filesystem;

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

void checkDataFile(std::string_view header, const fs::path& file) {
  try {
    regularFileSize(file);
  } catch (const Error& error) {
    fail(error.code(), "{}: its data file {}", header, error.what());
  }
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

void centreOnCells(VolumeGrid& grid) {
  glm::dvec3 middle{0};
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.dims[axis] > 1) middle[axis] = 0.5;
  }
  grid.origin = grid.worldFromIndex(middle);
  grid.dims = grid.cells();
}

void checkLayout(std::string_view name, const StoredLayout& layout) {
  if (layout.components < 1 || layout.components > kMostComponents) {
    fail(ExitCode::kVolume, "{}: {} components per voxel (expected 1 ... {})", name,
         layout.components, kMostComponents);
  }
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  const StoredLayout scalar{layout.dims, StoredType::kU8, 1};  // checkedDims has bounded its voxels
  if (scalar.bytes() > kMost / layout.voxelBytes()) {
    fail(ExitCode::kVolume, "{}: {} are more than can be addressed", name, describe(layout));
  }
}

namespace {

std::unique_ptr<StoredReader> rawReader(const StoredLayout& layout, const StoredVoxels& stored,
                                        std::uint64_t skipped) {
  const std::uint64_t start = stored.fileOffset + skipped;
  if (!stored.pieces.empty())
    return std::make_unique<PiecedVoxels>(layout, stored.pieces, start, stored.bigEndian);
  return std::make_unique<RawVoxels>(layout, stored.file, start, stored.bigEndian,
                                     stored.exactSize);
}

std::unique_ptr<ByteStream> streamOf(const StoredLayout& layout, const StoredVoxels& stored) {
  using Encoding = StoredVoxels::Encoding;
  regularFileSize(stored.file);
  FileHandle file{stored.file};
  if (stored.encoding == Encoding::kAscii) {
    const std::uint64_t before = stored.streamOffset / bytesPerNumber(stored.type);
    const std::uint64_t volumes =
        stored.isPlanar ? static_cast<std::uint64_t>(stored.components) : 1;
    return std::make_unique<TextStream>(
        std::move(file), stored.fileOffset, stored.type,
        before + volumes * (layout.bytes() / bytesPerNumber(layout.type)));
  }
  const bool isGzip = stored.encoding == Encoding::kGzip;
  return std::make_unique<GzipStream>(std::move(file), stored.fileOffset,
                                      isGzip ? DeflateWrapper::kGzip : DeflateWrapper::kZlibOrGzip);
}

const char* encodingName(StoredVoxels::Encoding encoding) {
  switch (encoding) {
    case StoredVoxels::Encoding::kRaw:
      return "raw";
    case StoredVoxels::Encoding::kGzip:
      return "gzip";
    case StoredVoxels::Encoding::kZlib:
      return "zlib";
    case StoredVoxels::Encoding::kAscii:
      return "ascii";
  }
  throw std::logic_error{"encoding out of range"};
}

}  // namespace

std::unique_ptr<BrickSource> openStoredVoxels(VolumeInfo info, const StoredVoxels& stored,
                                              const VolumeChoice& choice) {
  checkLayout(info.name, {info.grid.dims, stored.type, stored.components});
  const int component = chosenComponent(choice, stored.components);
  const StoredLayout layout{info.grid.dims, stored.type, stored.isPlanar ? 1 : stored.components};
  const std::uint64_t skipped =
      stored.isPlanar ? static_cast<std::uint64_t>(component) * layout.bytes() : 0;
  std::unique_ptr<StoredReader> reader;
  if (stored.encoding == StoredVoxels::Encoding::kRaw) {
    reader = rawReader(layout, stored, skipped);
  } else {
    const bool isNativeText = stored.encoding == StoredVoxels::Encoding::kAscii;
    const StreamPlace place{
        .start = stored.streamOffset + skipped,
        .bigEndian = isNativeText ? std::endian::native == std::endian::big : stored.bigEndian,
        .moreFollows = stored.isPlanar && component + 1 < stored.components};
    reader = std::make_unique<StreamedVoxels>(layout, streamOf(layout, stored), place);
  }
  info.components = stored.components;
  Conversion conversion;
  conversion.component = stored.isPlanar ? 0 : component;
  conversion.rescale = {stored.rescale};
  return std::make_unique<StoredSource>(std::move(info), std::move(reader), std::move(conversion),
                                        encodingName(stored.encoding));
}

}  // namespace burin::node
