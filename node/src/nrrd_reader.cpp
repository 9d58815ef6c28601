#include <teem/nrrd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "slicer_segments.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

struct FreeNrrd {
  void operator()(Nrrd* nrrd) const noexcept { nrrdNuke(nrrd); }
};
struct FreeIoState {
  void operator()(NrrdIoState* state) const noexcept {
    if (state->dataFile != nullptr) airFclose(state->dataFile);
    nrrdIoStateNix(state);
  }
};
using NrrdPointer = std::unique_ptr<Nrrd, FreeNrrd>;
using IoStatePointer = std::unique_ptr<NrrdIoState, FreeIoState>;

/// One message of teem's error stack without the function that said it.
std::string_view withoutFunction(std::string_view line) {
  const std::size_t function = line.find(": ");
  const bool hasFunction = line.starts_with("[nrrd]") && function != std::string_view::npos;
  return hasFunction ? line.substr(function + 2) : line;
}

/// Teem's error stack as one line: what it tried (a header line, a file) and the cause, which are
/// the last two of its messages.
std::string teemReason() {
  const std::unique_ptr<char, void (*)(void*)> text{biffGetDone(NRRD), std::free};
  if (text == nullptr) return "unknown reason";
  std::vector<std::string_view> lines;
  std::string_view rest{text.get()};
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (end > 0) lines.push_back(withoutFunction(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (lines.size() < 2) return lines.empty() ? "unknown reason" : std::string{lines.back()};
  return fmt::format("{}: {}", lines[lines.size() - 2], lines.back());
}

/// The header as teem reads it, and the data file, opened and placed on its first voxel byte (or on
/// the first byte of the gzip stream).
struct Header {
  NrrdPointer nrrd{nrrdNew()};
  IoStatePointer state{nrrdIoStateNew()};
};

/// The next line of a header, whichever way its lines end. False at the end of the file.
bool readLine(std::istream& in, std::string& line) {
  line.clear();
  for (int c = in.get(); c != std::char_traits<char>::eof(); c = in.get()) {
    if (c == '\r' && in.peek() == '\n') in.get();
    if (c == '\r' || c == '\n') return true;
    line += static_cast<char>(c);
  }
  return !line.empty();
}

/// Teem puts what it cannot read into messages of 1 KiB at most, however long it is.
constexpr std::size_t kLongestField = 512;
constexpr std::size_t kLongestName = 768;

/// Whether teem may quote the line: it takes comments and pairs of keys and values as they are.
bool isField(const std::string& line) {
  return !line.starts_with('#') && line.find(":=") == std::string::npos;
}

[[noreturn]] void failSeveral(const std::string& name) {
  fail(ExitCode::kVolume, "{}: several data files are not supported (expected one)", name);
}

/// What a header line says after "data file: ", if it is that field.
std::optional<std::string> dataFileField(const std::string& line) {
  std::string lower = line.substr(0, 16);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!lower.starts_with("data file: ") && !lower.starts_with("datafile: ")) return std::nullopt;
  const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
  return value == std::string::npos ? std::string{} : line.substr(value);
}

/// Whether a data file's name is a pattern of numbered ones, as "slice%03d.raw 1 64 1".
bool isPattern(const std::string& name) {
  for (std::size_t at = name.find('%'); at != std::string::npos; at = name.find('%', at + 1)) {
    const std::size_t behind = name.find_first_not_of("0123456789", at + 1);
    if (behind != std::string::npos && name[behind] == 'd') return true;
  }
  return false;
}

/// Throws unless this is a header of NRRD, which teem would otherwise take for one of the other
/// formats it knows, and unless every data file that it names is a regular file: teem opens the
/// first of them while it reads the header, and opening a FIFO would wait for ever.
void checkBeforeTeem(const std::string& name) {
  regularFileSize(name);
  if (name.size() > kLongestName)
    fail(ExitCode::kVolume, "{}: a name of {} bytes (expected at most {} for NRRD)", name,
         name.size(), kLongestName);
  const fs::path folder = fs::path{name}.parent_path();
  std::ifstream in{name, std::ios::binary};
  std::string line;
  constexpr std::string_view kMagic[] = {"NRRD00.01", "NRRD0001", "NRRD0002", "NRRD0003",
                                         "NRRD0004",  "NRRD0005", "NRRD0006"};
  if (!readLine(in, line) || std::ranges::find(kMagic, line) == std::end(kMagic)) {
    fail(ExitCode::kVolume, "{}: bad NRRD header: its first line is not {} ... {}", name, kMagic[1],
         kMagic[6]);
  }
  for (int number = 2; readLine(in, line) && !line.empty(); ++number) {
    if (isField(line) && line.size() > kLongestField)
      fail(ExitCode::kVolume, "{}: bad NRRD header: line {} has {} bytes (expected at most {})",
           name, number, line.size(), kLongestField);
    const auto value = dataFileField(line);
    if (!value) continue;
    if (isPattern(*value)) failSeveral(name);
    if (!value->starts_with("LIST")) {
      checkDataFile(name, folder / *value);
    } else {
      while (readLine(in, line) && !line.empty()) checkDataFile(name, folder / line);
    }
    return;
  }
}

Header readHeader(const std::string& name) {
  checkBeforeTeem(name);
  Header header;
  header.state->skipData = AIR_TRUE;
  header.state->keepNrrdDataFileOpen = AIR_TRUE;
  if (nrrdLoad(header.nrrd.get(), name.c_str(), header.state.get()) != 0) {
    // An attached header's file is teem's own again, and closed.
    if (header.state->detachedHeader == AIR_FALSE) header.state->dataFile = nullptr;
    fail(ExitCode::kVolume, "{}: bad NRRD header: {}", name, teemReason());
  }
  return header;
}

/// The axis along which components lie; nothing if voxels are scalars. A kind says so, or, where
/// there is a space, a direction that is missing.
std::optional<unsigned> componentAxis(const Nrrd& nrrd) {
  for (unsigned axis = 0; axis < nrrd.dim; ++axis) {
    const int kind = nrrd.axis[axis].kind;
    if (kind != nrrdKindUnknown && nrrdKindIsDomain(kind) == 0) return axis;
    if (nrrd.spaceDim == 3 && !AIR_EXISTS(nrrd.axis[axis].spaceDirection[0])) return axis;
  }
  return std::nullopt;
}

std::string sizesOf(const Nrrd& nrrd) {
  std::string sizes;
  for (unsigned axis = 0; axis < nrrd.dim; ++axis) {
    sizes += fmt::format("{}{}", axis == 0 ? "" : " x ", nrrd.axis[axis].size);
  }
  return sizes;
}

/// The three axes of space, fastest first.
std::array<unsigned, 3> spaceAxes(const std::string& name, const Nrrd& nrrd) {
  const auto components = componentAxis(nrrd);
  if (nrrd.dim != (components ? 4U : 3U)) {
    fail(ExitCode::kVolume, "{}: {} dimensions ({}{}; expected a volume with 3)", name, nrrd.dim,
         sizesOf(nrrd), components ? fmt::format(", axis {} holds components", *components) : "");
  }
  if (!components) return {0, 1, 2};
  if (*components != 0 && *components != 3) {
    fail(ExitCode::kVolume,
         "{}: axis {} holds components (sizes {}; expected the first or the last)", name,
         *components, sizesOf(nrrd));
  }
  return *components == 0 ? std::array<unsigned, 3>{1, 2, 3} : std::array<unsigned, 3>{0, 1, 2};
}

glm::ivec3 dimsOf(const std::string& name, const Nrrd& nrrd) {
  const auto [x, y, z] = spaceAxes(name, nrrd);
  return checkedDims(name, {static_cast<std::int64_t>(nrrd.axis[x].size),
                            static_cast<std::int64_t>(nrrd.axis[y].size),
                            static_cast<std::int64_t>(nrrd.axis[z].size)});
}

StoredType typeOf(const std::string& name, const Nrrd& nrrd) {
  switch (nrrd.type) {
    case nrrdTypeUChar:
      return StoredType::kU8;
    case nrrdTypeChar:
      return StoredType::kI8;
    case nrrdTypeUShort:
      return StoredType::kU16;
    case nrrdTypeShort:
      return StoredType::kI16;
    case nrrdTypeUInt:
      return StoredType::kU32;
    case nrrdTypeInt:
      return StoredType::kI32;
    case nrrdTypeULLong:
      return StoredType::kU64;
    case nrrdTypeLLong:
      return StoredType::kI64;
    case nrrdTypeFloat:
      return StoredType::kF32;
    case nrrdTypeDouble:
      return StoredType::kF64;
    default:
      fail(ExitCode::kVolume, "{}: voxel type \"{}\" is not supported (expected {})", name,
           airEnumStr(nrrdType, nrrd.type), supportedTypeNames());
  }
}

/// Signs that turn the file's space into LPS; nothing if the space is not anatomical.
std::optional<glm::dvec3> lpsSigns(int space) {
  switch (space) {
    case nrrdSpaceRightAnteriorSuperior:
      return glm::dvec3{-1, -1, 1};
    case nrrdSpaceLeftAnteriorSuperior:
      return glm::dvec3{1, -1, 1};
    case nrrdSpaceLeftPosteriorSuperior:
    case nrrdSpaceScannerXYZ:
      return glm::dvec3{1, 1, 1};
    default:
      return std::nullopt;
  }
}

/// Space directions and origin, turned to LPS where the space is anatomical.
void setOrientation(const Nrrd& nrrd, const std::array<unsigned, 3>& axes, VolumeInfo& info) {
  const auto signs = lpsSigns(nrrd.space);
  info.anatomical = signs.has_value();
  const glm::dvec3 turn = signs.value_or(glm::dvec3{1});
  for (int axis = 0; axis < 3; ++axis) {
    const double* vector = nrrd.axis[axes[static_cast<std::size_t>(axis)]].spaceDirection;
    const glm::dvec3 step{vector[0], vector[1], vector[2]};
    info.grid.spacing[axis] = glm::length(step);
    info.grid.direction[axis] = turn * step / info.grid.spacing[axis];
  }
  if (AIR_EXISTS(nrrd.spaceOrigin[0])) {
    const double* origin = nrrd.spaceOrigin;
    info.grid.origin = turn * glm::dvec3{origin[0], origin[1], origin[2]};
  }
}

/// Plain spacings along the file's own axes; 1 where the header says none.
void setSpacings(const Nrrd& nrrd, const std::array<unsigned, 3>& axes, VolumeInfo& info) {
  for (int axis = 0; axis < 3; ++axis) {
    const double spacing = nrrd.axis[axes[static_cast<std::size_t>(axis)]].spacing;
    if (!AIR_EXISTS(spacing)) continue;
    info.grid.spacing[axis] = std::abs(spacing);
    info.grid.direction[axis] *= spacing < 0 ? -1.0 : 1.0;
  }
}

std::vector<std::pair<std::string, std::string>> keyValuesOf(const Nrrd& nrrd) {
  std::vector<std::pair<std::string, std::string>> all;
  for (unsigned i = 0; i < nrrdKeyValueSize(&nrrd); ++i) {
    char* key = nullptr;
    char* value = nullptr;
    nrrdKeyValueIndex(&nrrd, &key, &value, i);
    const std::unique_ptr<char, void (*)(void*)> ownedKey{key, std::free};
    const std::unique_ptr<char, void (*)(void*)> ownedValue{value, std::free};
    if (key != nullptr && value != nullptr) all.emplace_back(key, value);
  }
  return all;
}

fs::path dataFileOf(const fs::path& headerFile, const NrrdIoState& state) {
  if (state.dataFNFormat != nullptr || state.dataFNArr->len > 1) failSeveral(headerFile.string());
  if (state.dataFNArr->len == 0) return headerFile;
  return headerFile.parent_path() / state.dataFN[0];
}

StoredVoxels storedVoxels(const fs::path& file, const Header& header) {
  const NrrdIoState& state = *header.state;
  StoredVoxels stored;
  stored.file = dataFileOf(file, state);
  stored.bigEndian = state.endian == airEndianBig;
  stored.type = typeOf(file.string(), *header.nrrd);
  if (const auto axis = componentAxis(*header.nrrd)) {
    const std::size_t components = header.nrrd->axis[*axis].size;
    if (components > kMostComponents) {
      fail(ExitCode::kVolume, "{}: {} components per voxel (expected at most {})", file.string(),
           components, kMostComponents);
    }
    stored.components = static_cast<int>(components);
    stored.isPlanar = *axis == 3;
  }
  BURIN_CHECK(state.dataFile != nullptr);
  stored.fileOffset = static_cast<std::uint64_t>(ftello(state.dataFile));
  if (state.encoding == nrrdEncodingGzip) {
    stored.encoding = StoredVoxels::Encoding::kGzip;
    if (state.byteSkip < 0) {
      fail(ExitCode::kVolume, "{}: byte skip {} in a gzip stream is not supported (expected >= 0)",
           file.string(), state.byteSkip);
    }
    stored.streamOffset = static_cast<std::uint64_t>(state.byteSkip);
  } else if (state.encoding == nrrdEncodingAscii) {
    stored.encoding = StoredVoxels::Encoding::kAscii;
  } else if (state.encoding != nrrdEncodingRaw) {
    fail(ExitCode::kVolume, "{}: encoding \"{}\" is not supported (expected raw, gzip or ascii)",
         file.string(), state.encoding->name);
  }
  return stored;
}

}  // namespace

bool recognisesNrrd(const FileStart& start) {
  return start.startsWith("NRRD0") || start.nameEndsWith(".nrrd") || start.nameEndsWith(".nhdr");
}

std::unique_ptr<BrickSource> openNrrd(const VolumeChoice& choice) {
  const Header header = readHeader(choice.file);
  VolumeInfo info;
  info.name = choice.file;
  info.format = "NRRD";
  info.labels = slicerSegments(keyValuesOf(*header.nrrd));
  info.grid.dims = dimsOf(choice.file, *header.nrrd);
  const auto axes = spaceAxes(choice.file, *header.nrrd);
  if (header.nrrd->spaceDim == 3) {
    setOrientation(*header.nrrd, axes, info);
  } else {
    setSpacings(*header.nrrd, axes, info);
  }
  checkGrid(choice.file, info.grid);
  return openStoredVoxels(std::move(info), storedVoxels(choice.file, header), choice);
}

}  // namespace burin::node
