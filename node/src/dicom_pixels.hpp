#pragma once

#include <memory>
#include <span>

#include "dicom_image.hpp"

namespace burin::node {

/// The pixels of a DICOM file, which is open as long as this is there.
class DicomPixels {
 public:
  /// Throws Error{kVolume} if the file cannot be read, is truncated, or packed as DCMTK cannot
  /// unpack it.
  explicit DicomPixels(DicomImage image);
  ~DicomPixels();
  DicomPixels(const DicomPixels&) = delete;
  DicomPixels& operator=(const DicomPixels&) = delete;

  const DicomImage& image() const { return image_; }

  /// One frame, all components of a pixel together, into `out`, which has exactly its size. The
  /// components are those that are stored: Y, Cb and Cr of colours that are stored so.
  void readFrame(int frame, std::span<std::byte> out);

 private:
  struct Open;

  DicomImage image_;
  std::unique_ptr<Open> open_;
};

}  // namespace burin::node
