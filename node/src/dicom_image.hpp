#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stored_source.hpp"

namespace burin::node {

/// What one DICOM file says of its pixels: a slice, or several frames of a volume.
struct DicomImage {
  std::filesystem::path file;
  std::string seriesUid;
  std::string description;  ///< modality and series description
  int instance = 0;         ///< instance number; 0 if there is none
  StoredLayout layout;      ///< columns, rows, frames
  glm::dvec2 storedRange{0};
  Rescale rescale;
  std::string encoding;                   ///< transfer syntax, in short
  std::optional<glm::dvec3> position;     ///< LPS, mm, of the first pixel of the first frame
  std::optional<glm::dvec3> lastFrame;    ///< the same of the last frame, if it is told
  std::optional<glm::dvec3> row, column;  ///< directions in which columns and rows count up
  glm::dvec2 spacing{1};                  ///< of columns, of rows; mm
  std::optional<double> sliceSpacing;     ///< as the header has it
};

/// Nothing if the file is no DICOM file, or one without pixels. Throws Error{kVolume} if it has
/// pixels of an unsupported kind.
std::optional<DicomImage> readDicomHeader(const std::filesystem::path& file);

/// Pixels of a box of `image`, whose z are frames; all components of a pixel together. Throws
/// Error{kVolume} if the file is truncated, damaged, or compressed in a way that GDCM cannot undo.
void readDicomPixels(const DicomImage& image, const IndexBox& box, std::span<std::byte> out);

}  // namespace burin::node
