#include "vti_header.hpp"

#include <expat.h>

#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "burin/common/error.hpp"
#include "file_handle.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

struct FreeParser {
  void operator()(XML_Parser parser) const noexcept { XML_ParserFree(parser); }
};
using ParserPointer = std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser>;

StoredType xmlTypeNamed(const std::string& file, std::string_view name) {
  constexpr std::pair<std::string_view, StoredType> kTypes[] = {
      {"UInt8", StoredType::kU8},   {"Int8", StoredType::kI8},    {"UInt16", StoredType::kU16},
      {"Int16", StoredType::kI16},  {"UInt32", StoredType::kU32}, {"Int32", StoredType::kI32},
      {"UInt64", StoredType::kU64}, {"Int64", StoredType::kI64},  {"Float32", StoredType::kF32},
      {"Float64", StoredType::kF64}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  fail(ExitCode::kVolume, "{}: voxel type \"{}\" is not supported (expected {})", file, name,
       supportedTypeNames());
}

/// Reads start tags until all is known, then stops the parser: what follows may be no XML.
class VtiParser {
 public:
  explicit VtiParser(const std::string& name) : name_{name}, file_{name} {}

  VtiHeader parse() {
    const ParserPointer parser{XML_ParserCreate(nullptr)};
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, onStart, [](void*, const XML_Char*) {});
    feed();
    if (failure_) std::rethrow_exception(failure_);
    if (!found_) {
      fail(ExitCode::kVolume,
           "{}: no array of points or cells (expected PointData with a DataArray)", name_);
    }
    if (isAppended_ && !isDone_) {
      fail(ExitCode::kVolume, "{}: AppendedData is missing, where array \"{}\" should be", name_,
           header_.arrayName);
    }
    if (isAppended_) placeAppended();
    return header_;
  }

 private:
  void feed() {
    std::array<std::byte, 65536> bytes{};
    for (std::uint64_t at = 0; !isDone_ && !failure_;) {
      const std::size_t got = file_.readSome(at, bytes);
      at += got;
      const bool isLast = got < bytes.size();
      const auto status = XML_Parse(parser_, reinterpret_cast<const char*>(bytes.data()),
                                    static_cast<int>(got), isLast ? 1 : 0);
      if (status == XML_STATUS_ERROR && XML_GetErrorCode(parser_) != XML_ERROR_ABORTED) {
        fail(ExitCode::kVolume, "{}: bad XML in line {}: {}", name_,
             XML_GetCurrentLineNumber(parser_), XML_ErrorString(XML_GetErrorCode(parser_)));
      }
      if (isLast) return;
    }
  }

  /// Expat is C: exceptions must not pass through it.
  static void onStart(void* self, const XML_Char* element, const XML_Char** attributes) {
    auto& parser = *static_cast<VtiParser*>(self);
    try {
      parser.attributes_ = attributes;
      parser.start(element);
    } catch (...) {
      parser.failure_ = std::current_exception();
      XML_StopParser(parser.parser_, XML_FALSE);
    }
  }

  void start(std::string_view element) {
    if (element == "VTKFile") startFile();
    if (element == "ImageData") startImage();
    if (element == "Piece") startPiece();
    if (element == "PointData" || element == "CellData") {
      isInArrays_ = true;
      isOfCells_ = element == "CellData";
      wanted_ = get("Scalars").value_or("");
    }
    if (element == "DataArray" && isInArrays_) startArray();
    if (element == "AppendedData") startAppended();
  }

  void startFile() {
    if (get("type").value_or("") != "ImageData") {
      fail(ExitCode::kVolume, "{}: VTKFile type=\"{}\" (expected ImageData)", name_,
           get("type").value_or(""));
    }
    header_.isBigEndian = get("byte_order").value_or("") == "BigEndian";
    header_.lengthBytes = get("header_type").value_or("UInt32") == "UInt64" ? 8 : 4;
    header_.compressor = get("compressor").value_or("");
  }

  void startImage() {
    header_.extent = numbersIn<int>(name_, "WholeExtent", get("WholeExtent").value_or(""), 6);
    if (const auto text = get("Origin"))
      header_.origin = numbersIn<double>(name_, "Origin", *text, 3);
    if (const auto text = get("Spacing"))
      header_.spacing = numbersIn<double>(name_, "Spacing", *text, 3);
    if (const auto text = get("Direction"))
      header_.direction = numbersIn<double>(name_, "Direction", *text, 9);
  }

  void startPiece() {
    const auto extent = numbersIn<int>(name_, "Extent", get("Extent").value_or(""), 6);
    if (extent != header_.extent) {
      fail(ExitCode::kVolume, "{}: a Piece of Extent \"{}\" (expected one piece of the whole)",
           name_, get("Extent").value_or(""));
    }
  }

  void startArray() {
    const std::string name{get("Name").value_or("")};
    if (found_ || (!wanted_.empty() && name != wanted_)) return;
    found_ = true;
    header_.isOfCells = isOfCells_;
    header_.arrayName = name;
    header_.type = xmlTypeNamed(name_, get("type").value_or(""));
    if (const auto text = get("NumberOfComponents"))
      header_.components = numberIn<int>(name_, "NumberOfComponents", *text);
    const std::string_view format = get("format").value_or("ascii");
    isAppended_ = format == "appended";
    if (isAppended_) {
      header_.offset = numberIn<std::uint64_t>(name_, "offset", get("offset").value_or(""));
      return;
    }
    if (format != "ascii" && format != "binary") {
      fail(ExitCode::kVolume, "{}: format=\"{}\" (expected ascii, binary or appended)", name_,
           format);
    }
    header_.format = format == "ascii" ? VtiFormat::kAscii : VtiFormat::kBase64;
    header_.offset = behindTag();
    stop();
  }

  void startAppended() {
    const std::string_view encoding = get("encoding").value_or("");
    if (encoding != "raw" && encoding != "base64") {
      fail(ExitCode::kVolume, "{}: AppendedData encoding=\"{}\" (expected raw or base64)", name_,
           encoding);
    }
    header_.format = encoding == "raw" ? VtiFormat::kRaw : VtiFormat::kBase64;
    appendedTag_ = behindTag();
    stop();
  }

  /// Offsets of appended arrays count from behind an underscore.
  void placeAppended() {
    std::array<std::byte, 256> bytes{};
    const std::size_t got = file_.readSome(appendedTag_, bytes);
    std::size_t at = 0;
    while (at < got && bytes[at] != std::byte{'_'}) ++at;
    if (at == got) fail(ExitCode::kVolume, "{}: no \"_\" behind AppendedData", name_);
    header_.offset += appendedTag_ + at + 1;
  }

  std::optional<std::string_view> get(std::string_view key) const {
    for (const XML_Char** at = attributes_; *at != nullptr; at += 2) {
      if (key == at[0]) return std::string_view{at[1]};
    }
    return std::nullopt;
  }

  std::uint64_t behindTag() const {
    return static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_)) +
           static_cast<std::uint64_t>(XML_GetCurrentByteCount(parser_));
  }

  void stop() {
    isDone_ = true;
    XML_StopParser(parser_, XML_FALSE);
  }

  std::string name_;
  FileHandle file_;
  XML_Parser parser_ = nullptr;
  const XML_Char** attributes_ = nullptr;
  VtiHeader header_;
  std::string wanted_;
  bool isInArrays_ = false;
  bool isOfCells_ = false;
  bool found_ = false;
  bool isAppended_ = false;
  bool isDone_ = false;
  std::uint64_t appendedTag_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

VtiHeader readVtiHeader(const std::string& file) {
  regularFileSize(file);
  return VtiParser{file}.parse();
}

}  // namespace burin::node
