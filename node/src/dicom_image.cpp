#include "dicom_image.hpp"

#include <gdcmBoxRegion.h>
#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmImageRegionReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "burin/common/error.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

const gdcm::Tag kPixelData{0x7fe0, 0x0010};
const gdcm::Tag kPosition{0x0020, 0x0032};
const gdcm::Tag kOrientation{0x0020, 0x0037};
const gdcm::Tag kSharedGroups{0x5200, 0x9229};
const gdcm::Tag kFrameGroups{0x5200, 0x9230};
const gdcm::Tag kPlanePosition{0x0020, 0x9113};
const gdcm::Tag kPlaneOrientation{0x0020, 0x9116};
const gdcm::Tag kPixelMeasures{0x0028, 0x9110};

/// The text of an element on one line, without the padding; empty if it is not there.
std::string textOf(const gdcm::DataSet& set, const gdcm::Tag& tag) {
  if (!set.FindDataElement(tag)) return "";
  const gdcm::ByteValue* const value = set.GetDataElement(tag).GetByteValue();
  if (value == nullptr || value->GetPointer() == nullptr) return "";
  std::string text{value->GetPointer(), value->GetLength()};
  text.resize(std::min(text.find('\0'), text.size()));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return std::string{trimmed(text)};
}

/// "1\2.5\3": the numbers of an element, if there are that many.
std::optional<std::vector<double>> numbersOf(const gdcm::DataSet& set, const gdcm::Tag& tag,
                                             std::size_t count) {
  std::string text = textOf(set, tag);
  std::ranges::replace(text, '\\', ' ');
  std::vector<double> numbers;
  for (const std::string_view word : words(text)) {
    const auto number = numberIn<double>(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<glm::dvec3> vectorOf(const gdcm::DataSet& set, const gdcm::Tag& tag) {
  const auto numbers = numbersOf(set, tag, 3);
  if (!numbers) return std::nullopt;
  return glm::dvec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/// The last (`isLast`) or first item of a sequence; nothing if there is none.
std::optional<gdcm::DataSet> itemOf(const gdcm::DataSet& set, const gdcm::Tag& sequence,
                                    bool isLast = false) {
  if (!set.FindDataElement(sequence)) return std::nullopt;
  const auto items = set.GetDataElement(sequence).GetValueAsSQ();
  if (items == nullptr || items->GetNumberOfItems() == 0) return std::nullopt;
  return items->GetItem(isLast ? items->GetNumberOfItems() : 1).GetNestedDataSet();
}

/// Where an enhanced file keeps an element of its first (or last) frame: among those of the frame,
/// or of all frames.
std::optional<gdcm::DataSet> groupOf(const gdcm::DataSet& set, const gdcm::Tag& group,
                                     bool isLast = false) {
  for (const gdcm::Tag& place : {kFrameGroups, kSharedGroups}) {
    const auto frame = itemOf(set, place, isLast);
    if (!frame) continue;
    if (auto found = itemOf(*frame, group)) return found;
  }
  return std::nullopt;
}

void readGeometry(const gdcm::DataSet& set, DicomImage& image) {
  image.position = vectorOf(set, kPosition);
  if (const auto first = groupOf(set, kPlanePosition)) {
    image.position = vectorOf(*first, kPosition);
    if (const auto last = groupOf(set, kPlanePosition, true))
      image.lastFrame = vectorOf(*last, kPosition);
  }
  auto orientation = numbersOf(set, kOrientation, 6);
  if (const auto group = groupOf(set, kPlaneOrientation))
    orientation = numbersOf(*group, kOrientation, 6);
  if (orientation) {
    const std::vector<double>& n = *orientation;
    image.row = glm::dvec3{n[0], n[1], n[2]};
    image.column = glm::dvec3{n[3], n[4], n[5]};
  }
  const gdcm::DataSet measures = groupOf(set, kPixelMeasures).value_or(set);
  for (const gdcm::Tag& tag : {gdcm::Tag{0x0028, 0x0030}, gdcm::Tag{0x0018, 0x1164}}) {
    // Pixel spacing, else imager pixel spacing: of rows first.
    const auto spacing = numbersOf(measures, tag, 2);
    if (!spacing) continue;
    image.spacing = {(*spacing)[1], (*spacing)[0]};
    break;
  }
  for (const gdcm::Tag& tag : {gdcm::Tag{0x0018, 0x0088}, gdcm::Tag{0x0018, 0x0050}}) {
    // Spacing between slices, else their thickness.
    const auto spacing = numbersOf(measures, tag, 1);
    if (!spacing || !(std::abs(spacing->front()) > 0)) continue;
    image.sliceSpacing = std::abs(spacing->front());
    break;
  }
}

void readLayout(const gdcm::File& file, DicomImage& image) {
  const std::vector<unsigned> dims = gdcm::ImageHelper::GetDimensionsValue(file);
  const gdcm::PixelFormat format = gdcm::ImageHelper::GetPixelFormatValue(file);
  const auto size = [&](std::size_t i) { return std::int64_t{i < dims.size() ? dims[i] : 1}; };
  image.layout.dims =
      checkedDims(image.file.string(), {size(0), size(1), std::max<std::int64_t>(size(2), 1)});
  image.layout.components = format.GetSamplesPerPixel();
  const bool isSigned = format.GetPixelRepresentation() == 1;
  const auto type =
      storedTypeFromName(fmt::format("{}{}", isSigned ? "i" : "u", format.GetBitsAllocated()));
  if (!type || format.GetBitsStored() > format.GetBitsAllocated()) {
    fail(ExitCode::kVolume, "{}: pixels of {} bits are not supported (expected 8, 16 or 32)",
         image.file.string(), format.GetBitsAllocated());
  }
  image.layout.type = *type;
  image.storedRange = {static_cast<double>(format.GetMin()), static_cast<double>(format.GetMax())};
  const auto scale = gdcm::ImageHelper::GetRescaleInterceptSlopeValue(file);
  image.rescale = {scale[1], scale[0]};
}

std::string syntaxName(const gdcm::TransferSyntax& syntax) {
  using gdcm::TransferSyntax;
  switch (static_cast<TransferSyntax::TSType>(syntax)) {
    case TransferSyntax::ImplicitVRLittleEndian:
    case TransferSyntax::ExplicitVRLittleEndian:
    case TransferSyntax::ExplicitVRBigEndian:
      return "raw";
    case TransferSyntax::DeflatedExplicitVRLittleEndian:
      return "deflated";
    case TransferSyntax::RLELossless:
      return "RLE";
    case TransferSyntax::JPEGLSLossless:
    case TransferSyntax::JPEGLSNearLossless:
      return "JPEG-LS";
    case TransferSyntax::JPEG2000Lossless:
    case TransferSyntax::JPEG2000:
      return "JPEG 2000";
    case TransferSyntax::JPEGBaselineProcess1:
    case TransferSyntax::JPEGExtendedProcess2_4:
    case TransferSyntax::JPEGLosslessProcess14:
    case TransferSyntax::JPEGLosslessProcess14_1:
      return "JPEG";
    default:
      return fmt::format("transfer syntax {}", syntax.GetString());
  }
}

/// GDCM fills up what is missing at the end of a truncated file; we do not. `start`: byte at which
/// the pixels begin.
void checkSize(const gdcm::TransferSyntax& syntax, std::uint64_t start, const DicomImage& image) {
  if (syntax.IsEncapsulated() || syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
    return;
  const std::uint64_t expected = start + image.layout.bytes();
  const std::uint64_t found = regularFileSize(image.file);
  if (found >= expected) return;
  fail(ExitCode::kVolume, "{}: truncated: {} bytes found, {} expected ({})", image.file.string(),
       found, expected, describe(image.layout));
}

/// GDCM's complaints go to the standard error; ours say what is wrong.
void silence() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

}  // namespace

std::optional<DicomImage> readDicomHeader(const std::filesystem::path& path) {
  silence();
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  if (!reader.CanRead() || !reader.ReadUpToTag(kPixelData, {kPixelData})) return std::nullopt;
  const gdcm::File& file = reader.GetFile();
  const gdcm::DataSet& set = file.GetDataSet();
  const gdcm::Tag rows{0x0028, 0x0010};
  const gdcm::Tag columns{0x0028, 0x0011};
  if (!set.FindDataElement(rows) || !set.FindDataElement(columns)) return std::nullopt;
  DicomImage image;
  image.file = path;
  image.seriesUid = textOf(set, {0x0020, 0x000e});
  image.description =
      std::string{trimmed(textOf(set, {0x0008, 0x0060}) + " " + textOf(set, {0x0008, 0x103e}))};
  const auto instance = numbersOf(set, {0x0020, 0x0013}, 1);
  image.instance = instance ? static_cast<int>(std::clamp(instance->front(), -1e9, 1e9)) : 0;
  readLayout(file, image);
  readGeometry(set, image);
  const gdcm::TransferSyntax& syntax = file.GetHeader().GetDataSetTransferSyntax();
  image.encoding = syntaxName(syntax);
  checkSize(syntax, reader.GetStreamCurrentPosition(), image);
  return image;
}

namespace {

[[noreturn]] void failPixels(const DicomImage& image) {
  fail(ExitCode::kVolume,
       "{}: its pixels cannot be read ({}; truncated, damaged or compressed in an unknown way; "
       "expected {})",
       image.file.string(), image.encoding, describe(image.layout));
}

/// Component after component of a slice, to all components of a pixel together.
void interleave(std::vector<char>& pixels, const StoredLayout& layout) {
  const std::size_t each = bytesPerNumber(layout.type);
  const auto components = static_cast<std::size_t>(layout.components);
  const std::size_t count = pixels.size() / each / components;
  std::vector<char> mixed(pixels.size());
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(&mixed[(i * components + c) * each], &pixels[(c * count + i) * each], each);
  pixels = std::move(mixed);
}

/// Of a file with one frame.
void readFrame(const DicomImage& image, const IndexBox& box, std::span<std::byte> out) {
  gdcm::ImageReader reader;
  reader.SetFileName(image.file.c_str());
  if (!reader.Read()) failPixels(image);
  const gdcm::Image& decoded = reader.GetImage();
  std::vector<char> pixels(decoded.GetBufferLength());
  if (pixels.size() != image.layout.bytes() || !decoded.GetBuffer(pixels.data())) failPixels(image);
  if (image.layout.components > 1 && decoded.GetPlanarConfiguration() == 1)
    interleave(pixels, image.layout);
  copyVoxels(std::as_bytes(std::span{pixels}), {glm::ivec3{0}, image.layout.dims}, out, box, box,
             image.layout.voxelBytes());
}

}  // namespace

void readDicomPixels(const DicomImage& image, const IndexBox& box, std::span<std::byte> out) {
  silence();
  if (image.layout.dims.z == 1) {
    readFrame(image, box, out);
    return;
  }
  gdcm::ImageRegionReader reader;
  reader.SetFileName(image.file.c_str());
  if (!reader.ReadInformation()) failPixels(image);
  gdcm::BoxRegion region;
  const auto at = [](int n) { return static_cast<unsigned>(n); };
  region.SetDomain(at(box.lo.x), at(box.hi.x) - 1, at(box.lo.y), at(box.hi.y) - 1, at(box.lo.z),
                   at(box.hi.z) - 1);
  reader.SetRegion(region);
  if (reader.ComputeBufferLength() != out.size() ||
      !reader.ReadIntoBuffer(reinterpret_cast<char*>(out.data()), out.size()))
    failPixels(image);
}

}  // namespace burin::node
