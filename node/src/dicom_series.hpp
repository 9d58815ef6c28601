#pragma once

#include <span>
#include <string>
#include <vector>

#include "burin/node/brick_source.hpp"
#include "dicom_image.hpp"

namespace burin::node {

/// Slices of one volume, in the order of its z.
struct DicomSeries {
  std::vector<DicomImage> images;  ///< one, or as many as slices
  VolumeGrid grid;
  bool anatomical = false;
  std::string notice;  ///< a gantry tilt, or what had to be assumed
};

/// Whether there is any DICOM file below the folder.
bool hasDicomFiles(const std::filesystem::path& folder);

/// The series of a folder (with the folders in it) that `choice` means, or the one file. Throws
/// Error{kVolume} if there is none, if there are several and none is chosen (lists them), or if its
/// slices make no regular grid: some are missing, twice there, or differ in size or direction.
DicomSeries readDicomSeries(const VolumeChoice& choice);

}  // namespace burin::node
