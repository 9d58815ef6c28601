#pragma once

#include <string>
#include <vector>

#include "dicom_image.hpp"

namespace burin::node {

/// What arranging and reading images takes, as bytes (CBOR); without the texts that name a series
/// to its user.
std::string writeDicomTable(const std::vector<DicomImage>& images);

/// The images of writeDicomTable().
std::vector<DicomImage> readDicomTable(const std::string& table);

}  // namespace burin::node
