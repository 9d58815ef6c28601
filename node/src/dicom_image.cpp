#include "dicom_image.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcmetinf.h>
#include <dcmtk/dcmdata/dcsequen.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "burin/common/error.hpp"
#include "dicom_file.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

/// The text of an element on one line, without the padding; empty if it is not there. DCMTK makes
/// room for as many bytes as an element says that it has, so none is believed that is no text's.
std::string textOf(DcmItem& item, const DcmTagKey& tag) {
  constexpr std::uint32_t kLongestText = 1 << 16;
  DcmElement* element = nullptr;
  if (item.findAndGetElement(tag, element).bad() || element->getLengthField() > kLongestText)
    return "";
  OFString found;
  if (element->getOFStringArray(found).bad()) return "";
  std::string text{found.c_str()};  // ends at a zero byte
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return std::string{trimmed(text)};
}

/// Places and lengths beyond are no header's but damage, and so far from each other that their
/// differences are none.
constexpr double kMostNumber = 1e15;

/// "1\2.5\3": the numbers of an element, if there are that many.
std::optional<std::vector<double>> numbersOf(DcmItem& item, const DcmTagKey& tag,
                                             std::size_t count) {
  std::string text = textOf(item, tag);
  std::ranges::replace(text, '\\', ' ');
  std::vector<double> numbers;
  for (const std::string_view word : words(text)) {
    const auto number = numberIn<double>(word);
    if (!number || !(std::abs(*number) <= kMostNumber)) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<double> numberOf(DcmItem& item, const DcmTagKey& tag) {
  const auto numbers = numbersOf(item, tag, 1);
  if (!numbers) return std::nullopt;
  return numbers->front();
}

std::optional<glm::dvec3> vectorOf(DcmItem& item, const DcmTagKey& tag) {
  const auto numbers = numbersOf(item, tag, 3);
  if (!numbers) return std::nullopt;
  return glm::dvec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/// A whole number of the header; `otherwise` if it is not there or none.
int wholeOf(DcmItem& item, const DcmTagKey& tag, int otherwise) {
  const auto number = numberOf(item, tag);
  return number ? static_cast<int>(std::clamp(*number, -1e9, 1e9)) : otherwise;
}

/// An item of a sequence; the last one if `index` is -1. Null if there is none.
DcmItem* itemOf(DcmItem& parent, const DcmTagKey& sequence, int index = 0) {
  DcmItem* item = nullptr;
  return parent.findAndGetSequenceItem(sequence, item, index).good() ? item : nullptr;
}

/// Where an enhanced file keeps an element of a frame (the last one if `frame` is -1): among those
/// of the frame, or of all frames. Null if it is no such file.
DcmItem* groupOf(DcmItem& set, const DcmTagKey& group, int frame = 0) {
  if (DcmItem* const own = itemOf(set, DCM_PerFrameFunctionalGroupsSequence, frame)) {
    if (DcmItem* const found = itemOf(*own, group)) return found;
  }
  DcmItem* const shared = itemOf(set, DCM_SharedFunctionalGroupsSequence);
  return shared == nullptr ? nullptr : itemOf(*shared, group);
}

void readPosition(DcmItem& set, DicomImage& image) {
  image.position = vectorOf(set, DCM_ImagePositionPatient);
  if (DcmItem* const first = groupOf(set, DCM_PlanePositionSequence)) {
    image.position = vectorOf(*first, DCM_ImagePositionPatient);
    if (DcmItem* const last = groupOf(set, DCM_PlanePositionSequence, -1))
      image.lastFrame = vectorOf(*last, DCM_ImagePositionPatient);
  }
  DcmItem* const group = groupOf(set, DCM_PlaneOrientationSequence);
  const auto n = numbersOf(group == nullptr ? set : *group, DCM_ImageOrientationPatient, 6);
  if (!n) return;
  image.row = glm::dvec3{(*n)[0], (*n)[1], (*n)[2]};
  image.column = glm::dvec3{(*n)[3], (*n)[4], (*n)[5]};
}

void readSpacing(DcmItem& set, DicomImage& image) {
  DcmItem* const group = groupOf(set, DCM_PixelMeasuresSequence);
  DcmItem& measures = group == nullptr ? set : *group;
  for (const DcmTagKey& tag : {DCM_PixelSpacing, DCM_ImagerPixelSpacing}) {
    const auto spacing = numbersOf(measures, tag, 2);  // of rows first
    if (!spacing) continue;
    image.spacing = {(*spacing)[1], (*spacing)[0]};
    break;
  }
  for (const DcmTagKey& tag : {DCM_SpacingBetweenSlices, DCM_SliceThickness}) {
    const auto spacing = numberOf(measures, tag);
    if (!spacing || !(std::abs(*spacing) > 0)) continue;
    image.sliceSpacing = std::abs(*spacing);
    break;
  }
}

/// Slope 0, as some files have it where there is none, means 1.
Rescale rescaleOf(DcmItem& item) {
  const double slope = numberOf(item, DCM_RescaleSlope).value_or(1);
  return {slope == 0 ? 1 : slope, numberOf(item, DCM_RescaleIntercept).value_or(0)};
}

void readRescale(DcmItem& set, DicomImage& image) {
  image.rescale = {rescaleOf(set)};
  DcmSequenceOfItems* frames = nullptr;
  set.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames);
  const auto count = static_cast<unsigned long>(image.layout.dims.z);
  const bool isPerFrame = frames != nullptr && frames->card() == count &&
                          itemOf(*frames->getItem(0), DCM_PixelValueTransformationSequence);
  DcmItem* const shared = groupOf(set, DCM_PixelValueTransformationSequence);
  if (shared != nullptr) image.rescale = {rescaleOf(*shared)};
  if (!isPerFrame) return;
  for (unsigned long frame = 1; frame < count; ++frame) {
    DcmItem* const own = itemOf(*frames->getItem(frame), DCM_PixelValueTransformationSequence);
    image.rescale.push_back(own == nullptr ? image.rescale.front() : rescaleOf(*own));
  }
}

void readSize(DcmItem& set, DicomImage& image) {
  image.layout.dims =
      checkedDims(image.file.string(), {wholeOf(set, DCM_Columns, 0), wholeOf(set, DCM_Rows, 0),
                                        std::max(wholeOf(set, DCM_NumberOfFrames, 1), 1)});
  const int components = wholeOf(set, DCM_SamplesPerPixel, 1);
  if (components != 1 && components != 3 && components != 4)  // DICOM PS3.3, C.7.6.3.1.1
    fail(ExitCode::kVolume, "{}: {} samples per pixel (expected 1, 3 or 4)", image.file.string(),
         components);
  image.layout.components = components;
  checkLayout(image.file.string(), image.layout);
  StoredLayout frame = image.layout;
  frame.dims.z = 1;
  // DCMTK counts a frame's bytes in 32 bits; a pixel's number has four at most.
  if (frame.bytes() > std::numeric_limits<std::uint32_t>::max() / 4) {
    fail(ExitCode::kVolume, "{}: frames of {} x {} pixels (expected less than 4 GB)",
         image.file.string(), frame.dims.x, frame.dims.y);
  }
}

void readPixelType(DcmItem& set, DicomImage& image) {
  const int allocated = wholeOf(set, DCM_BitsAllocated, 0);
  const bool isSigned = wholeOf(set, DCM_PixelRepresentation, 0) == 1;
  const auto type = storedTypeFromName(fmt::format("{}{}", isSigned ? "i" : "u", allocated));
  if (!type || allocated > 32) {
    fail(ExitCode::kVolume, "{}: pixels of {} bits are not supported (expected 8, 16 or 32)",
         image.file.string(), allocated);
  }
  image.layout.type = *type;
  image.bitsStored = wholeOf(set, DCM_BitsStored, allocated);
  image.highBit = wholeOf(set, DCM_HighBit, image.bitsStored - 1);
  if (image.bitsStored < 1 || image.highBit >= allocated || image.highBit < image.bitsStored - 1) {
    fail(ExitCode::kVolume, "{}: {} bits up to bit {} stored (expected such that {} bits hold)",
         image.file.string(), image.bitsStored, image.highBit, allocated);
  }
  const double most = std::ldexp(1.0, image.bitsStored);
  image.storedRange = isSigned ? glm::dvec2{-most / 2, most / 2 - 1} : glm::dvec2{0, most - 1};
  image.photometric = textOf(set, DCM_PhotometricInterpretation);
  image.isPlanar = image.layout.components > 1 && wholeOf(set, DCM_PlanarConfiguration, 0) == 1;
}

/// That the pixels of a file which is whole are so, too. `bytes`: what their element has; packed
/// ones do not say it.
void checkLength(std::uint32_t bytes, const DicomImage& image) {
  if (bytes == DCM_UndefinedLength || bytes >= image.layout.bytes()) return;
  fail(ExitCode::kVolume, "{}: truncated: {} bytes of pixels found, {} expected ({})",
       image.file.string(), bytes, image.layout.bytes(), describe(image.layout));
}

/// Of files with a header of their own, which all are that lie on disks (DICOM PS3.10, 7.1).
bool hasDicomMagic(const std::filesystem::path& path) {
  constexpr int kPreamble = 128;
  std::array<char, 4> magic{};
  std::ifstream in{path, std::ios::binary};
  return in.seekg(kPreamble).read(magic.data(), magic.size()) &&
         std::string_view{magic.data(), magic.size()} == "DICM";
}

}  // namespace

std::optional<DicomImage> readDicomHeader(const std::filesystem::path& path) {
  DcmFileFormat file;
  const OFCondition loaded = loadDicomFile(path, file);
  DcmDataset& set = *file.getDataset();
  if (!set.tagExists(DCM_Rows) || !set.tagExists(DCM_Columns)) {
    if (loaded.bad() && hasDicomMagic(path))
      fail(ExitCode::kVolume, "{}: truncated or damaged: {} bytes found ({})", path.string(),
           regularFileSize(path), loaded.text());
    return std::nullopt;
  }
  DicomImage image;
  image.file = path;
  image.seriesUid = textOf(set, DCM_SeriesInstanceUID);
  image.description =
      std::string{trimmed(textOf(set, DCM_Modality) + " " + textOf(set, DCM_SeriesDescription))};
  image.instance = wholeOf(set, DCM_InstanceNumber, 0);
  image.syntaxUid = textOf(*file.getMetaInfo(), DCM_TransferSyntaxUID);
  readSize(set, image);
  readPixelType(set, image);
  if (loaded.bad()) {
    fail(ExitCode::kVolume, "{}: truncated or damaged: {} bytes found (expected {}; {})",
         path.string(), regularFileSize(path), describe(image.layout), loaded.text());
  }
  DcmElement* pixels = nullptr;
  if (set.findAndGetElement(DCM_PixelData, pixels).bad())
    fail(ExitCode::kVolume, "{}: truncated or damaged: no pixels (expected {})", path.string(),
         describe(image.layout));
  checkLength(pixels->getLengthField(), image);
  readPosition(set, image);
  readSpacing(set, image);
  readRescale(set, image);
  return image;
}

}  // namespace burin::node
