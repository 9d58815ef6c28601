#include "dicom_syntax.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <algorithm>
#include <array>
#include <utility>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// What the packed pixels of a file can be, as DCMTK's decoders have it. DICOM PS3.5, annex A.
constexpr std::array<std::pair<const char*, const char*>, 14> kSyntaxes{{
    {UID_LittleEndianImplicitTransferSyntax, "raw"},
    {UID_LittleEndianExplicitTransferSyntax, "raw"},
    {UID_BigEndianExplicitTransferSyntax, "raw"},
    {UID_DeflatedExplicitVRLittleEndianTransferSyntax, "deflated"},
    {UID_RLELosslessTransferSyntax, "RLE"},
    {UID_JPEGProcess1TransferSyntax, "JPEG"},
    {UID_JPEGProcess2_4TransferSyntax, "JPEG"},
    {UID_JPEGProcess6_8TransferSyntax, "JPEG"},
    {UID_JPEGProcess10_12TransferSyntax, "JPEG"},
    {UID_JPEGProcess14TransferSyntax, "JPEG"},
    {UID_JPEGProcess14SV1TransferSyntax, "JPEG"},
    {UID_JPEGLSLosslessTransferSyntax, "JPEG-LS"},
    {UID_JPEGLSLossyTransferSyntax, "JPEG-LS"},
    // A file without a header of its own is taken for what DICOM's default is.
    {"", "raw"},
}};

}  // namespace

std::string dicomEncoding(const DicomImage& image) {
  const auto found = std::ranges::find(kSyntaxes, image.syntaxUid,
                                       [](const auto& syntax) { return syntax.first; });
  if (found != kSyntaxes.end()) {
    const std::string_view encoding = found->second;
    if (encoding == "raw" && image.photometric.find("_42") != std::string::npos) {
      fail(ExitCode::kVolume, "{}: raw pixels of {} (expected a colour for each: {})",
           image.file.string(), image.photometric, "RGB or YBR_FULL");
    }
    return std::string{encoding};
  }
  const DcmXfer known{image.syntaxUid.c_str()};
  const std::string name = known.getXfer() == EXS_Unknown ? "unknown" : known.getXferName();
  fail(ExitCode::kVolume,
       "{}: transfer syntax {} ({}) is not supported (expected raw, deflated, RLE, JPEG or JPEG-LS "
       "pixels; \"gdcmconv --raw IN OUT\" unpacks JPEG 2000)",
       image.file.string(), image.syntaxUid, name);
}

bool isRawDicom(const DicomImage& image) {
  const std::string encoding = dicomEncoding(image);
  return encoding == "raw" || encoding == "deflated";
}

}  // namespace burin::node
