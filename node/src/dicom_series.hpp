#pragma once

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

/// The images of the series in a folder (with the folders in it) that `choice` means, or the one
/// file. Throws Error{kVolume} if there is none, or if there are several series and none is chosen
/// (lists them).
std::vector<DicomImage> findDicomSeries(const VolumeChoice& choice);

/// The volume that such images make; `name`: for messages. Throws Error{kVolume} if their slices
/// make no regular grid: some are missing, twice there, or differ in size or direction.
DicomSeries arrangeDicomSeries(const std::string& name, std::vector<DicomImage> images);

}  // namespace burin::node
