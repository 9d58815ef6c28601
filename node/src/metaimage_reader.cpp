// MetaImage, "Key = Value" lines before the voxels or beside them. Its libraries are part of ITK
// and VTK; all that is needed of them is where the voxels begin.
#include <algorithm>
#include <map>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "file_handle.hpp"
#include "number_pattern.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

/// The fields, and where the line of the last one, ElementDataFile, ends.
struct MetaHeader {
  std::string name;  ///< of the file, for messages
  std::map<std::string, std::string, std::less<>> fields;
  std::uint64_t end = 0;            ///< bytes of the file
  std::vector<std::string> listed;  ///< lines that follow "ElementDataFile = LIST"

  /// The first of these keys that is there, as the format has had several words for some.
  std::optional<std::string_view> find(std::initializer_list<std::string_view> keys) const {
    for (const std::string_view key : keys) {
      const auto found = fields.find(key);
      if (found != fields.end()) return found->second;
    }
    return std::nullopt;
  }
  std::string_view need(std::string_view key) const {
    if (const auto value = find({key})) return *value;
    fail(ExitCode::kVolume, "{}: bad MetaImage header: {} is missing", name, key);
  }
  bool isTrue(std::initializer_list<std::string_view> keys, bool otherwise) const {
    const auto value = find(keys);
    if (!value) return otherwise;
    if (*value == "True" || *value == "true" || *value == "1") return true;
    if (*value == "False" || *value == "false" || *value == "0") return false;
    fail(ExitCode::kVolume, "{}: {} = {} (expected True or False)", name, *keys.begin(), *value);
  }
  std::optional<std::vector<double>> numbers(std::initializer_list<std::string_view> keys,
                                             std::size_t count) const {
    const auto value = find(keys);
    if (!value) return std::nullopt;
    return numbersIn<double>(name, *keys.begin(), *value, count);
  }
};

/// The longest header that is read: a list of 10,000 files has less.
constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20;

MetaHeader readMetaHeader(const std::string& name) {
  regularFileSize(name);
  std::string text(kMostHeaderBytes, '\0');
  text.resize(FileHandle{name}.readSome(0, std::as_writable_bytes(std::span{text})));
  MetaHeader header{name, {}, 0, {}};
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto line = std::string_view{text}.substr(at, end - at);
    at = std::min(end + 1, text.size());
    const std::size_t equals = line.find('=');
    const std::string key{trimmed(line.substr(0, equals))};
    if (key.empty()) continue;
    if (equals == std::string_view::npos || key.size() > 80) {
      fail(ExitCode::kVolume, "{}: bad MetaImage header: \"{}\" (expected KEY = VALUE)", name,
           key.substr(0, 40));
    }
    header.fields[key] = trimmed(line.substr(equals + 1));
    if (key == "ElementDataFile") break;
  }
  header.end = at;
  if (header.need("ElementDataFile").starts_with("LIST")) {
    for (const std::string_view file : words(std::string_view{text}.substr(at)))
      header.listed.emplace_back(file);
  }
  return header;
}

StoredType typeOf(const MetaHeader& header) {
  // A "long" is of 4 bytes in this format, whatever it is in C.
  static const std::map<std::string_view, StoredType> kTypes{
      {"MET_UCHAR", StoredType::kU8},       {"MET_CHAR", StoredType::kI8},
      {"MET_USHORT", StoredType::kU16},     {"MET_SHORT", StoredType::kI16},
      {"MET_UINT", StoredType::kU32},       {"MET_INT", StoredType::kI32},
      {"MET_ULONG", StoredType::kU32},      {"MET_LONG", StoredType::kI32},
      {"MET_ULONG_LONG", StoredType::kU64}, {"MET_LONG_LONG", StoredType::kI64},
      {"MET_FLOAT", StoredType::kF32},      {"MET_DOUBLE", StoredType::kF64}};
  std::string_view written = header.need("ElementType");
  if (written.ends_with("_ARRAY")) written.remove_suffix(6);
  const auto found = kTypes.find(written);
  if (found != kTypes.end()) return found->second;
  fail(ExitCode::kVolume,
       "{}: ElementType {} is not supported (expected MET_ and one of UCHAR, "
       "CHAR, USHORT, SHORT, UINT, INT, ULONG_LONG, LONG_LONG, FLOAT, DOUBLE)",
       header.name, written);
}

glm::ivec3 dimsOf(const MetaHeader& header) {
  const int count = numberIn<int>(header.name, "NDims", header.need("NDims"));
  if (count != 3) {
    fail(ExitCode::kVolume, "{}: NDims = {} (DimSize {}; expected a volume with 3)", header.name,
         count, header.find({"DimSize"}).value_or(""));
  }
  const auto sizes = numbersIn<std::int64_t>(header.name, "DimSize", header.need("DimSize"), 3);
  return checkedDims(header.name, {sizes[0], sizes[1], sizes[2]});
}

/// The rows of the matrix are the directions of the axes. World is LPS, as ITK has it, if the file
/// says anything of a body; what it says there (RAI, ...) describes the matrix and adds nothing.
void setOrientation(const MetaHeader& header, VolumeInfo& info) {
  const auto orientation = header.find({"AnatomicalOrientation"});
  info.anatomical = orientation && orientation->find('?') == std::string_view::npos;
  const auto spacing = header.numbers({"ElementSpacing", "ElementSize"}, 3);
  const auto origin = header.numbers({"Offset", "Origin", "Position"}, 3);
  const auto matrix = header.numbers({"TransformMatrix", "Rotation", "Orientation"}, 9);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (spacing) info.grid.spacing[axis] = (*spacing)[a];
    if (origin) info.grid.origin[axis] = (*origin)[a];
    if (!matrix) continue;
    const glm::dvec3 row{(*matrix)[3 * a], (*matrix)[3 * a + 1], (*matrix)[3 * a + 2]};
    info.grid.spacing[axis] *= glm::length(row);
    info.grid.direction[axis] = row / glm::length(row);
  }
}

/// "slice%03d.raw 1 64 1": the first and last number, and the step.
std::vector<fs::path> numberedFiles(const MetaHeader& header, std::string_view value,
                                    const fs::path& folder, int slices) {
  const auto fields = words(value);
  const auto pattern = parseNumberPattern(fields.front());
  constexpr long kMost = 1L << 30;  // no sum of ours overflows
  bool isInRange = pattern.has_value();
  const auto number = [&](std::size_t at, long otherwise) {
    if (at >= fields.size()) return otherwise;
    const long n = numberIn<long>(header.name, "ElementDataFile", fields[at]);
    isInRange = isInRange && n >= 0 && n <= kMost;
    return std::clamp(n, 0L, kMost);
  };
  const long first = number(1, 1);
  const long step = number(3, 1);
  const long last = number(2, first + (slices - 1) * step);
  constexpr long kMostFiles = 1 << 20;
  if (!isInRange || step < 1 || last < first || (last - first) / step >= kMostFiles) {
    fail(ExitCode::kVolume,
         "{}: ElementDataFile = {} (expected a name with %d, the first number, the last one and "
         "the step)",
         header.name, value);
  }
  std::vector<fs::path> files;
  for (long n = first; n <= last; n += step) files.push_back(folder / pattern->name(n));
  return files;
}

/// Which files hold the voxels, each checked to be one.
void findData(const MetaHeader& header, int slices, StoredVoxels& stored) {
  const fs::path folder = fs::path{header.name}.parent_path();
  const std::string_view value = header.need("ElementDataFile");
  if (value == "LOCAL" || value == "Local" || value == "local") {
    stored.file = header.name;
    stored.fileOffset = header.end;
    return;
  }
  if (value.starts_with("LIST")) {
    for (const std::string& name : header.listed) stored.pieces.push_back(folder / name);
    if (stored.pieces.empty()) {
      fail(ExitCode::kVolume, "{}: ElementDataFile = LIST, but no file is listed", header.name);
    }
  } else if (value.find('%') != std::string_view::npos) {
    stored.pieces = numberedFiles(header, value, folder, slices);
  } else {
    stored.file = folder / value;
    checkDataFile(header.name, stored.file);
  }
  for (const fs::path& file : stored.pieces) checkDataFile(header.name, file);
}

/// HeaderSize: bytes before the voxels in their file; -1 says that the voxels end it.
void skipHeader(const MetaHeader& header, const StoredLayout& layout, StoredVoxels& stored) {
  const auto value = header.find({"HeaderSize"});
  if (!value) return;
  const auto size = numberIn<std::int64_t>(header.name, "HeaderSize", *value);
  if (size >= 0) {
    stored.fileOffset += static_cast<std::uint64_t>(size);
    return;
  }
  const std::uint64_t pieces = std::max<std::size_t>(stored.pieces.size(), 1);
  const std::uint64_t bytes = layout.bytes() / pieces;
  const std::uint64_t found =
      regularFileSize(stored.pieces.empty() ? stored.file : stored.pieces.front());
  stored.fileOffset = found - std::min(found, bytes);
}

StoredVoxels storedVoxels(const MetaHeader& header, const glm::ivec3& dims) {
  StoredVoxels stored;
  stored.type = typeOf(header);
  if (const auto channels = header.find({"ElementNumberOfChannels"})) {
    stored.components = numberIn<int>(header.name, "ElementNumberOfChannels", *channels);
  }
  stored.bigEndian = header.isTrue({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
  findData(header, dims.z, stored);
  if (!header.isTrue({"BinaryData"}, true)) {
    stored.encoding = StoredVoxels::Encoding::kAscii;
  } else if (header.isTrue({"CompressedData"}, false)) {
    stored.encoding = StoredVoxels::Encoding::kZlib;
  } else {
    checkLayout(header.name, {dims, stored.type, stored.components});
    skipHeader(header, {dims, stored.type, stored.components}, stored);
  }
  if (stored.encoding != StoredVoxels::Encoding::kRaw && !stored.pieces.empty()) {
    fail(ExitCode::kVolume,
         "{}: several data files that are compressed or text are not supported "
         "(expected one, or raw ones)",
         header.name);
  }
  if (const auto slope = header.numbers({"ElementToIntensityFunctionSlope"}, 1))
    stored.rescale.slope = slope->front();
  if (const auto offset = header.numbers({"ElementToIntensityFunctionOffset"}, 1))
    stored.rescale.intercept = offset->front();
  return stored;
}

}  // namespace

bool recognisesMetaImage(const FileStart& start) {
  return start.startsWith("ObjectType = ") || start.nameEndsWith(".mha") ||
         start.nameEndsWith(".mhd");
}

std::unique_ptr<BrickSource> openMetaImage(const VolumeChoice& choice) {
  const MetaHeader header = readMetaHeader(choice.file);
  VolumeInfo info;
  info.name = choice.file;
  info.format = "MetaImage";
  info.grid.dims = dimsOf(header);
  setOrientation(header, info);
  checkGrid(choice.file, info.grid);
  const StoredVoxels stored = storedVoxels(header, info.grid.dims);
  return openStoredVoxels(std::move(info), stored, choice);
}

}  // namespace burin::node
