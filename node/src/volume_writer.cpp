#include "burin/node/volume_writer.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/memory_room.hpp"
#include "burin/common/temporary_file.hpp"
#include "gzip_writer.hpp"
#include "slab_reading.hpp"
#include "volume_headers.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span{text});
}

/// Appends `head` and all voxels, as one gzip stream if asked to.
void append(TemporaryFile& out, bool gzip, std::span<const std::byte> head, BrickSource& source,
            const WriteOptions& options) {
  constexpr std::size_t kSlabBytes = std::size_t{32} << 20;
  std::optional<GzipWriter> stream;
  if (gzip) stream.emplace(out);
  const auto write = [&](std::span<const std::byte> bytes) {
    if (stream) {
      stream->write(bytes);
    } else {
      out.write(bytes);
    }
  };
  const IndexBox volume{glm::ivec3{0}, source.info().grid.dims};
  const auto writeSlab = [&](const Slab& slab) {
    write(slab.voxels);
    if (options.progress) {
      options.progress(static_cast<double>(slab.box.hi.z) / static_cast<double>(volume.hi.z));
    }
  };
  write(head);
  readOwnSlabs(source, std::span{&volume, 1}, writeSlab, kSlabBytes);
  if (stream) stream->finish();
}

void writeNrrd(BrickSource& source, const fs::path& file, const WriteOptions& options) {
  TemporaryFile out{file};
  out.write(bytesOf(nrrdHeader(source.info(), options.gzip, "")));
  append(out, options.gzip, {}, source, options);
  out.commit();
}

void writeDetachedNrrd(BrickSource& source, const fs::path& file, const WriteOptions& options) {
  fs::path voxelFile = file;
  voxelFile.replace_extension(options.gzip ? ".raw.gz" : ".raw");
  std::error_code ignored;
  if (fs::exists(voxelFile, ignored) && !fs::exists(file, ignored)) {
    fail(ExitCode::kUsage, "{}: is there without {} and would be replaced (expected another name)",
         voxelFile.string(), file.filename().string());
  }
  TemporaryFile voxels{voxelFile};
  TemporaryFile header{file};
  header.write(bytesOf(nrrdHeader(source.info(), options.gzip, voxelFile.filename().string())));
  append(voxels, options.gzip, {}, source, options);
  header.close();
  voxels.commit();
  header.commit();  // last: it names the other file
}

void writeNifti(BrickSource& source, const fs::path& file, const WriteOptions& options) {
  const auto header = niftiHeader(source.info(), file.string());
  TemporaryFile out{file};
  append(out, file.extension() == ".gz", header, source, options);
  out.commit();
}

void writeRaw(BrickSource& source, const fs::path& file, const WriteOptions& options) {
  TemporaryFile out{file};
  append(out, file.extension() == ".gz", {}, source, options);
  out.commit();
}

/// Before hours of writing that cannot end well.
void checkDiskRoom(const BrickSource& source, const fs::path& file) {
  std::error_code unknown;
  const fs::space_info space = fs::space(fs::absolute(file).parent_path(), unknown);
  const std::uintmax_t needed = source.info().bytes();
  if (unknown || needed <= space.free) return;
  fail(ExitCode::kRank, "{}: {} are to be written, the disk has {} left", file.string(),
       byteText(static_cast<std::int64_t>(needed)),
       byteText(static_cast<std::int64_t>(space.free)));
}

struct Writer {
  std::string_view extension;
  void (*write)(BrickSource& source, const fs::path& file, const WriteOptions& options);
};

constexpr Writer kWriters[] = {{".nrrd", writeNrrd}, {".nhdr", writeDetachedNrrd},
                               {".nii", writeNifti}, {".nii.gz", writeNifti},
                               {".raw", writeRaw},   {".raw.gz", writeRaw}};

}  // namespace

std::string_view writableExtensions() {
  return ".nrrd .nhdr .nii .nii.gz .raw .raw.gz";
}

void writeVolume(BrickSource& source, const fs::path& file, const WriteOptions& options) {
  const std::string name = file.filename().string();
  const auto writer = std::ranges::find_if(
      kWriters, [&](const Writer& candidate) { return name.ends_with(candidate.extension); });
  if (writer == std::end(kWriters)) {
    fail(ExitCode::kUsage, "{}: unknown extension of a volume file (expected one of {})",
         file.string(), writableExtensions());
  }
  if (!options.gzip && !name.ends_with(".gz")) checkDiskRoom(source, file);
  writer->write(source, file, options);
}

}  // namespace burin::node
