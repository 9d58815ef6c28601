// VTK's XML format of images, .vti: text, base64 or raw arrays, as they are or in zlib blocks.
#include <utility>

#include "base64_stream.hpp"
#include "burin/common/error.hpp"
#include "byte_order.hpp"
#include "file_formats.hpp"
#include "file_stream.hpp"
#include "raw_voxels.hpp"
#include "stored_voxels.hpp"
#include "streamed_voxels.hpp"
#include "text_stream.hpp"
#include "vti_header.hpp"
#include "zlib_block_stream.hpp"

namespace burin::node {
namespace {

std::unique_ptr<ByteStream> streamAt(const std::string& file, VtiFormat format,
                                     std::uint64_t offset) {
  if (format == VtiFormat::kRaw) return std::make_unique<FileStream>(FileHandle{file}, offset);
  return std::make_unique<Base64Stream>(FileHandle{file}, offset);
}

/// The next `count` numbers of the lengths that stand before the data.
std::vector<std::uint64_t> readLengths(const VtiHeader& header, ByteStream& stream,
                                       std::uint64_t count) {
  if (count > stream.mostBytes() / header.lengthBytes) {
    fail(ExitCode::kVolume,
         "{}: {} compressed blocks announced (expected no more than the file has "
         "room for)",
         stream.path().string(), count);
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(count) * header.lengthBytes);
  if (stream.readSome(bytes) != bytes.size()) {
    fail(ExitCode::kVolume, "{}: truncated: no data at byte {}, where array \"{}\" should be",
         stream.path().string(), header.offset, header.arrayName);
  }
  if (swapNeeded(header.isBigEndian)) swapBytes(bytes, header.lengthBytes);
  std::vector<std::uint64_t> lengths;
  for (std::size_t i = 0; i < count; ++i) {
    lengths.push_back(header.lengthBytes == 8 ? voxelAt<std::uint64_t>(bytes.data(), i)
                                              : voxelAt<std::uint32_t>(bytes.data(), i));
  }
  return lengths;
}

/// Lengths first (number of blocks, size of each, of the last one if it is smaller, packed sizes),
/// then the blocks; in base64 these are two texts.
std::unique_ptr<ByteStream> blocksOf(const std::string& file, const VtiHeader& header) {
  const auto stream = streamAt(file, header.format, header.offset);
  const auto counts = readLengths(header, *stream, 3);
  const auto packed = readLengths(header, *stream, counts[0]);
  std::vector<ZlibBlockStream::Block> blocks;
  for (const std::uint64_t bytes : packed) blocks.push_back({bytes, counts[1]});
  if (!blocks.empty() && counts[2] != 0) blocks.back().unpacked = counts[2];
  const std::uint64_t lengthBytes = stream->position();
  const std::uint64_t taken =
      header.format == VtiFormat::kRaw ? lengthBytes : base64Characters(lengthBytes);
  return std::make_unique<ZlibBlockStream>(streamAt(file, header.format, header.offset + taken),
                                           std::move(blocks));
}

/// Behind the spaces that stand before a text.
std::uint64_t behindSpaces(const std::string& file, std::uint64_t offset) {
  const FileHandle handle{file};
  std::byte c{};
  while (
      handle.readSome(offset, std::span{&c, 1}) == 1 &&
      (c == std::byte{' '} || c == std::byte{'\n'} || c == std::byte{'\r'} || c == std::byte{'\t'}))
    ++offset;
  return offset;
}

void checkLength(const std::string& file, std::uint64_t found, const StoredLayout& layout) {
  if (found == layout.bytes()) return;
  fail(ExitCode::kVolume, "{}: {} bytes of data ({} expected for {})", file, found, layout.bytes(),
       describe(layout));
}

std::unique_ptr<StoredReader> voxelsOf(const std::string& file, VtiHeader header,
                                       const StoredLayout& layout) {
  if (header.format == VtiFormat::kAscii) {
    const std::uint64_t count = layout.bytes() / bytesPerNumber(layout.type);
    const bool isBigHost = std::endian::native == std::endian::big;
    return std::make_unique<StreamedVoxels>(
        layout, std::make_unique<TextStream>(FileHandle{file}, header.offset, layout.type, count),
        StreamPlace{0, isBigHost, false});
  }
  if (header.format == VtiFormat::kBase64) header.offset = behindSpaces(file, header.offset);
  if (!header.compressor.empty()) {
    auto blocks = blocksOf(file, header);
    checkLength(file, blocks->mostBytes(), layout);
    return std::make_unique<StreamedVoxels>(layout, std::move(blocks),
                                            StreamPlace{0, header.isBigEndian, false});
  }
  auto stream = streamAt(file, header.format, header.offset);
  checkLength(file, readLengths(header, *stream, 1).front(), layout);
  if (header.format == VtiFormat::kRaw) {
    return std::make_unique<RawVoxels>(layout, file, header.offset + header.lengthBytes,
                                       header.isBigEndian, false);
  }
  // Another array's text may follow without anything between.
  return std::make_unique<StreamedVoxels>(
      layout, std::move(stream), StreamPlace{header.lengthBytes, header.isBigEndian, true});
}

void setGrid(const std::string& name, const VtiHeader& header, VolumeInfo& info) {
  if (header.extent.empty()) fail(ExitCode::kVolume, "{}: ImageData is missing", name);
  const auto size = [&](std::size_t axis) {
    return std::int64_t{header.extent[2 * axis + 1]} - header.extent[2 * axis] + 1;
  };
  info.grid.dims = checkedDims(name, {size(0), size(1), size(2)});
  glm::dvec3 first{0};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    info.grid.spacing[axis] = header.spacing[a];
    info.grid.origin[axis] = header.origin[a];
    first[axis] = header.extent[2 * a];
    for (int row = 0; row < 3; ++row)
      info.grid.direction[axis][row] = header.direction[3 * static_cast<std::size_t>(row) + a];
  }
  checkGrid(name, info.grid);
  info.grid.origin = info.grid.worldFromIndex(first);
  if (header.isOfCells) centreOnCells(info.grid);
}

std::string encodingOf(const VtiHeader& header) {
  const char* const format = header.format == VtiFormat::kAscii    ? "ascii"
                             : header.format == VtiFormat::kBase64 ? "base64"
                                                                   : "raw";
  const bool isPacked = !header.compressor.empty() && header.format != VtiFormat::kAscii;
  return isPacked ? fmt::format("zlib {}", format) : format;
}

}  // namespace

bool recognisesVti(const FileStart& start) {
  if (start.nameEndsWith(".vti")) return true;
  const std::string_view text{reinterpret_cast<const char*>(start.bytes.data()),
                              start.bytes.size()};
  return text.find("<VTKFile type=\"ImageData\"") != std::string_view::npos;
}

std::unique_ptr<BrickSource> openVti(const VolumeChoice& choice) {
  const VtiHeader header = readVtiHeader(choice.file);
  if (!header.compressor.empty() && header.compressor != "vtkZLibDataCompressor") {
    fail(ExitCode::kVolume,
         "{}: compressor \"{}\" is not supported (expected vtkZLibDataCompressor)", choice.file,
         header.compressor);
  }
  VolumeInfo info;
  info.name = choice.file;
  info.format = "VTK XML";
  setGrid(choice.file, header, info);
  const StoredLayout layout{info.grid.dims, header.type, header.components};
  checkLayout(choice.file, layout);
  Conversion conversion;
  conversion.component = chosenComponent(choice, header.components);
  return std::make_unique<StoredSource>(std::move(info), voxelsOf(choice.file, header, layout),
                                        std::move(conversion), encodingOf(header));
}

}  // namespace burin::node
