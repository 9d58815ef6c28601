#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
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
  int bitsStored = 8;       ///< of those that `layout.type` has
  int highBit = 7;          ///< the uppermost of them
  glm::dvec2 storedRange{0};
  std::vector<Rescale> rescale{{}};  ///< one for all frames, or one per frame
  std::string syntaxUid;             ///< transfer syntax: how the pixels are packed
  std::string photometric;           ///< "MONOCHROME2", "RGB", "YBR_FULL", ...
  bool isPlanar = false;  ///< components of a frame lie one after another, if they are not packed
  std::optional<glm::dvec3> position;     ///< LPS, mm, of the first pixel of the first frame
  std::optional<glm::dvec3> lastFrame;    ///< the same of the last frame, if it is told
  std::optional<glm::dvec3> row, column;  ///< directions in which columns and rows count up
  glm::dvec2 spacing{1};                  ///< of columns, of rows; mm
  std::optional<double> sliceSpacing;     ///< as the header has it
};

/// Nothing if the file is no DICOM file, or one without pixels. Throws Error{kVolume} if it has
/// pixels of an unsupported kind, is truncated or damaged.
std::optional<DicomImage> readDicomHeader(const std::filesystem::path& file);

}  // namespace burin::node
