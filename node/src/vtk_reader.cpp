// VTK's legacy format, structured points: a few lines of text, then an array, big-endian or text.

#include <optional>
#include <utility>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "file_handle.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

/// Lines of a file whose rest may be binary.
class LineReader {
 public:
  explicit LineReader(const std::string& file) : file_{file} {}

  std::uint64_t offset() const { return offset_; }
  void skip(std::uint64_t bytes) { offset_ += bytes; }

  /// The next line without its end; nothing at the end of the file.
  std::optional<std::string> next() {
    std::string line(kLongest, '\0');
    line.resize(file_.readSome(offset_, std::as_writable_bytes(std::span{line})));
    if (line.empty()) return std::nullopt;
    const std::size_t end = line.find('\n');
    if (end == std::string::npos && line.size() == kLongest) {
      fail(ExitCode::kVolume, "{}: a line of more than {} characters at byte {} (expected a field)",
           file_.path().string(), kLongest, offset_);
    }
    offset_ += std::min(end == std::string::npos ? line.size() : end + 1, line.size());
    line.resize(std::min(end, line.size()));
    return line;
  }

  /// The next line that is not blank.
  std::optional<std::string> nextField() {
    while (auto line = next()) {
      if (!trimmed(*line).empty()) return line;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kLongest = 1024;
  FileHandle file_;
  std::uint64_t offset_ = 0;
};

StoredType typeNamed(const std::string& file, std::string_view name) {
  constexpr std::pair<std::string_view, StoredType> kTypes[] = {
      {"unsigned_char", StoredType::kU8},  {"char", StoredType::kI8},
      {"signed_char", StoredType::kI8},    {"unsigned_short", StoredType::kU16},
      {"short", StoredType::kI16},         {"unsigned_int", StoredType::kU32},
      {"int", StoredType::kI32},           {"vtkIdType", StoredType::kI32},
      {"unsigned_long", StoredType::kU64}, {"long", StoredType::kI64},
      {"vtktypeuint64", StoredType::kU64}, {"vtktypeint64", StoredType::kI64},
      {"float", StoredType::kF32},         {"double", StoredType::kF64}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  fail(ExitCode::kVolume, "{}: voxel type \"{}\" is not supported (expected {})", file, name,
       supportedTypeNames());
}

/// What stands before the array that is read.
struct VtkHeader {
  std::string name;  ///< of the file
  bool isText = false;
  std::vector<std::int64_t> dims;
  std::vector<double> origin{0, 0, 0};
  std::vector<double> spacing{1, 1, 1};
  bool isOfCells = false;
  std::int64_t tuples = 0;
  StoredType type = StoredType::kU8;
  int components = 1;
  std::uint64_t offset = 0;  ///< of the array
};

class VtkHeaderParser {
 public:
  explicit VtkHeaderParser(const std::string& file) : lines_{file} { header_.name = file; }

  VtkHeader parse() {
    readPreamble();
    while (auto line = lines_.nextField()) {
      if (readField(words(*line))) return header_;
    }
    fail(ExitCode::kVolume, "{}: no array of points or cells (expected POINT_DATA and SCALARS)",
         header_.name);
  }

 private:
  using Words = std::vector<std::string_view>;

  void readPreamble() {
    const auto magic = lines_.next();
    const auto title = lines_.next();
    const auto kind = lines_.nextField();
    const auto dataset = lines_.nextField();
    if (!magic || !magic->starts_with("# vtk DataFile") || !title || !kind || !dataset) {
      fail(ExitCode::kVolume,
           "{}: bad VTK header (expected \"# vtk DataFile Version\", a title, ASCII "
           "or BINARY, DATASET)",
           header_.name);
    }
    header_.isText = trimmed(*kind) == "ASCII";
    if (!header_.isText && trimmed(*kind) != "BINARY") {
      fail(ExitCode::kVolume, "{}: \"{}\" (expected ASCII or BINARY)", header_.name,
           trimmed(*kind).substr(0, 40));
    }
    const Words fields = words(*dataset);
    if (fields.size() != 2 || fields[0] != "DATASET" || fields[1] != "STRUCTURED_POINTS") {
      fail(ExitCode::kVolume, "{}: \"{}\" (expected DATASET STRUCTURED_POINTS)", header_.name,
           trimmed(*dataset).substr(0, 60));
    }
  }

  template <typename Number>
  std::vector<Number> three(const Words& fields) const {
    std::string rest;
    for (std::size_t i = 1; i < fields.size(); ++i) rest += std::string{fields[i]} + " ";
    return numbersIn<Number>(header_.name, fields[0], rest, 3);
  }

  template <typename Number>
  Number number(const Words& fields, std::size_t at) const {
    return numberIn<Number>(header_.name, fields[0], at < fields.size() ? fields[at] : "");
  }

  /// True if it is the array.
  bool readField(const Words& fields) {
    const std::string_view key = fields[0];
    if (key == "DIMENSIONS") header_.dims = three<std::int64_t>(fields);
    if (key == "ORIGIN") header_.origin = three<double>(fields);
    if (key == "SPACING" || key == "ASPECT_RATIO") header_.spacing = three<double>(fields);
    if (key == "POINT_DATA" || key == "CELL_DATA") {
      header_.isOfCells = key == "CELL_DATA";
      header_.tuples = number<std::int64_t>(fields, 1);
    }
    if (key == "FIELD") return readArrays(number<int>(fields, 2));
    if (key == "SCALARS") return foundScalars(fields);
    if (key == "COLOR_SCALARS")
      return found(header_.isText ? StoredType::kF32 : StoredType::kU8, number<int>(fields, 2));
    if (key == "VECTORS" || key == "NORMALS") return found(typeOf(fields, 2), 3);
    return false;
  }

  StoredType typeOf(const Words& fields, std::size_t at) const {
    return typeNamed(header_.name, at < fields.size() ? fields[at] : "");
  }

  bool found(StoredType type, int components) {
    header_.type = type;
    header_.components = components;
    header_.offset = lines_.offset();
    return true;
  }

  bool foundScalars(const Words& fields) {
    const StoredType type = typeOf(fields, 2);
    const int components = fields.size() > 3 ? number<int>(fields, 3) : 1;
    const std::uint64_t behind = lines_.offset();
    const auto table = lines_.next();
    if (!table || !table->starts_with("LOOKUP_TABLE")) {
      fail(ExitCode::kVolume, "{}: no LOOKUP_TABLE behind SCALARS, at byte {}", header_.name,
           behind);
    }
    return found(type, components);
  }

  /// Arrays of a FIELD: the first one of points or cells is what is looked for; those of the whole
  /// dataset, which stand before, are skipped.
  bool readArrays(int count) {
    for (int i = 0; i < count; ++i) {
      const auto line = lines_.nextField();
      const Words fields = line ? words(*line) : Words{};
      if (fields.size() != 4) {
        fail(ExitCode::kVolume, "{}: bad FIELD (expected NAME COMPONENTS TUPLES TYPE)",
             header_.name);
      }
      const int components = number<int>(fields, 1);
      const auto tuples = number<std::int64_t>(fields, 2);
      constexpr std::int64_t kMostTuples = std::int64_t{1} << 40;  // so that products fit
      if (components < 1 || components > kMostComponents || tuples < 0 || tuples > kMostTuples) {
        fail(ExitCode::kVolume, "{}: array {} of {} tuples of {} (expected as many as fit)",
             header_.name, fields[0], tuples, components);
      }
      if (header_.tuples > 0 && tuples == header_.tuples) {
        return found(typeOf(fields, 3), components);
      }
      skipArray(typeOf(fields, 3), tuples * components);
    }
    return false;
  }

  void skipArray(StoredType type, std::int64_t numbers) {
    if (!header_.isText) {
      lines_.skip(static_cast<std::uint64_t>(numbers) * bytesPerNumber(type));
      return;
    }
    for (std::int64_t seen = 0; seen < numbers;) {
      const auto line = lines_.nextField();
      if (!line) return;
      seen += static_cast<std::int64_t>(words(*line).size());
    }
  }

  LineReader lines_;
  VtkHeader header_;
};

void setGrid(const VtkHeader& header, VolumeInfo& info) {
  if (header.dims.empty()) {
    fail(ExitCode::kVolume, "{}: DIMENSIONS are missing before the array", header.name);
  }
  info.grid.dims = checkedDims(header.name, {header.dims[0], header.dims[1], header.dims[2]});
  info.grid.origin = {header.origin[0], header.origin[1], header.origin[2]};
  info.grid.spacing = {header.spacing[0], header.spacing[1], header.spacing[2]};
  if (header.isOfCells) centreOnCells(info.grid);
  if (static_cast<std::uint64_t>(header.tuples) != info.grid.voxelCount()) {
    fail(ExitCode::kVolume, "{}: {} {} ({} expected for DIMENSIONS {} {} {})", header.name,
         header.isOfCells ? "CELL_DATA" : "POINT_DATA", header.tuples, info.grid.voxelCount(),
         header.dims[0], header.dims[1], header.dims[2]);
  }
}

}  // namespace

bool recognisesVtk(const FileStart& start) {
  return start.startsWith("# vtk DataFile") || start.nameEndsWith(".vtk");
}

std::unique_ptr<BrickSource> openVtk(const VolumeChoice& choice) {
  regularFileSize(choice.file);
  const VtkHeader header = VtkHeaderParser{choice.file}.parse();
  VolumeInfo info;
  info.name = choice.file;
  info.format = "VTK";
  setGrid(header, info);
  checkGrid(choice.file, info.grid);
  StoredVoxels stored;
  stored.file = choice.file;
  stored.encoding = header.isText ? StoredVoxels::Encoding::kAscii : StoredVoxels::Encoding::kRaw;
  stored.fileOffset = header.offset;
  stored.bigEndian = true;
  stored.type = header.type;
  stored.components = header.components;
  return openStoredVoxels(std::move(info), stored, choice);
}

}  // namespace burin::node
