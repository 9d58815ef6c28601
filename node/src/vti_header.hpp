#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stored_type.hpp"

namespace burin::node {

/// How an array of a .vti file is written.
enum class VtiFormat { kAscii, kBase64, kRaw };

/// What the XML of a .vti file says, as far as its voxels need it.
struct VtiHeader {
  bool isBigEndian = false;
  std::size_t lengthBytes = 4;  ///< of the numbers before the data: UInt32 or UInt64
  std::string compressor;       ///< empty: none
  std::vector<int> extent;      ///< first and last index along x, y, z
  std::vector<double> origin{0, 0, 0};
  std::vector<double> spacing{1, 1, 1};
  std::vector<double> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< rows of a matrix
  bool isOfCells = false;
  std::string arrayName;
  StoredType type = StoredType::kU8;
  int components = 1;
  VtiFormat format = VtiFormat::kAscii;
  std::uint64_t offset = 0;  ///< of the array's text or bytes in the file
};

/// The array is the one that PointData names as its scalars, else the first one; of CellData if
/// there is none of points. Throws Error{kVolume}.
VtiHeader readVtiHeader(const std::string& file);

}  // namespace burin::node
