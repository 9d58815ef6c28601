#pragma once

#include <string>

#include "dicom_image.hpp"

namespace burin::node {

/// How the pixels are packed, in short: "raw", "JPEG-LS". Throws Error{kVolume} if DCMTK cannot
/// unpack them (JPEG 2000, films), or if they are raw and several share their colours.
std::string dicomEncoding(const DicomImage& image);

/// Whether pixels lie in the file as they are, so that `image.isPlanar` and the byte order count.
bool isRawDicom(const DicomImage& image);

}  // namespace burin::node
