#include "dicom_pixels.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dccodec.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>

#include <cstring>
#include <type_traits>
#include <utility>

#include "burin/common/error.hpp"
#include "dicom_file.hpp"
#include "dicom_syntax.hpp"
#include "jpeg_header.hpp"

namespace burin::node {
namespace {

/// The decoders of this process. Colours stay as they are stored, a pixel's components together.
class Decoders {
 public:
  Decoders() {
    DcmRLEDecoderRegistration::registerCodecs();
    DJDecoderRegistration::registerCodecs(EDC_never, EUC_default, EPC_colorByPixel);
    DJLSDecoderRegistration::registerCodecs(EJLSUC_default, EJLSPC_colorByPixel);
  }
  ~Decoders() {
    DJLSDecoderRegistration::cleanup();
    DJDecoderRegistration::cleanup();
    DcmRLEDecoderRegistration::cleanup();
  }
  Decoders(const Decoders&) = delete;
  Decoders& operator=(const Decoders&) = delete;
};

void registerDecoders() {
  static const Decoders decoders;
}

[[noreturn]] void failPixels(const DicomImage& image, const std::string& reason) {
  fail(ExitCode::kVolume, "{}: its pixels cannot be read ({}: {}; expected {})",
       image.file.string(), dicomEncoding(image), reason, describe(image.layout));
}

/// Component after component of a frame, to all components of a pixel together.
void interleave(std::span<std::byte> pixels, const StoredLayout& layout) {
  const std::size_t each = bytesPerNumber(layout.type);
  const auto components = static_cast<std::size_t>(layout.components);
  const std::size_t count = pixels.size() / each / components;
  const std::vector<std::byte> planes{pixels.begin(), pixels.end()};
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(&pixels[(i * components + c) * each], &planes[(c * count + i) * each], each);
}

/// Clears the bits that are not the pixel's own (overlays once lay there) and copies its sign into
/// them.
void keepStoredBits(std::span<std::byte> pixels, const DicomImage& image) {
  withStoredType(image.layout.type, [&](auto tag) {
    using Pixel = typename decltype(tag)::Type;
    if constexpr (std::is_integral_v<Pixel>) {
      using Bits = std::make_unsigned_t<Pixel>;
      constexpr int kAllocated = 8 * sizeof(Pixel);
      if (image.bitsStored == kAllocated) return;
      for (std::size_t at = 0; at < pixels.size(); at += sizeof(Pixel)) {
        Bits bits = 0;
        std::memcpy(&bits, &pixels[at], sizeof bits);
        bits = static_cast<Bits>(bits << (kAllocated - 1 - image.highBit));
        // Right shifts of signed numbers bring the sign along (C++20).
        const auto value =
            static_cast<Pixel>(static_cast<Pixel>(bits) >> (kAllocated - image.bitsStored));
        std::memcpy(&pixels[at], &value, sizeof value);
      }
    }
  });
}

/// Nothing if it has none, or no whole one.
std::span<const std::byte> firstFragment(DcmPixelData& pixels, int frame, int frames) {
  E_TransferSyntax syntax = EXS_Unknown;
  const DcmRepresentationParameter* parameter = nullptr;
  pixels.getOriginalRepresentationKey(syntax, parameter);
  DcmPixelSequence* fragments = nullptr;
  DcmPixelItem* item = nullptr;
  Uint32 number = 0;
  Uint8* bytes = nullptr;
  if (pixels.getEncapsulatedRepresentation(syntax, parameter, fragments).bad() ||
      DcmCodec::determineStartFragment(static_cast<Uint32>(frame), frames, fragments, number)
          .bad() ||
      fragments->getItem(item, number).bad() || item->getUint8Array(bytes).bad() ||
      bytes == nullptr)
    return {};
  return std::as_bytes(std::span{bytes, item->getLength()});
}

}  // namespace

struct DicomPixels::Open {
  DcmFileFormat file;
  DcmPixelData* pixels = nullptr;
  DcmFileCache cache;
  std::vector<std::byte> scratch;  ///< DCMTK wants an even number of bytes
};

DicomPixels::DicomPixels(DicomImage image)
    : image_{std::move(image)}, open_{std::make_unique<Open>()} {
  registerDecoders();
  const OFCondition loaded = loadDicomFile(image_.file, open_->file);
  if (loaded.bad()) failPixels(image_, loaded.text());
  DcmElement* element = nullptr;
  open_->file.getDataset()->findAndGetElement(DCM_PixelData, element);
  open_->pixels = dynamic_cast<DcmPixelData*>(element);
  if (open_->pixels == nullptr) failPixels(image_, "no pixels in it");
}

DicomPixels::~DicomPixels() = default;

void DicomPixels::readFrame(int frame, std::span<std::byte> out) {
  // DCMTK 3.6 would look for it for ever among some markers that cannot stand before it.
  if (dicomEncoding(image_) == "JPEG" &&
      !hasJpegFrameHeader(firstFragment(*open_->pixels, frame, image_.layout.dims.z)))
    failPixels(image_, "a frame does not begin as JPEG does");
  open_->scratch.resize(out.size() + out.size() % 2);
  Uint32 fragment = 0;  // the frame's first one: DCMTK finds it
  OFString colours;
  const OFCondition read = open_->pixels->getUncompressedFrame(
      open_->file.getDataset(), static_cast<Uint32>(frame), fragment, open_->scratch.data(),
      static_cast<Uint32>(open_->scratch.size()), colours, &open_->cache);
  if (read.bad()) failPixels(image_, read.text());
  std::memcpy(out.data(), open_->scratch.data(), out.size());
  const bool keepsPlanes = isRawDicom(image_) || dicomEncoding(image_) == "RLE";
  if (image_.isPlanar && keepsPlanes) interleave(out, image_.layout);
  keepStoredBits(out, image_);
}

}  // namespace burin::node
