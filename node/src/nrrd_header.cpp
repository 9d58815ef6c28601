#include <fmt/format.h>

#include <bit>

#include "volume_headers.hpp"

namespace burin::node {
namespace {

const char* nrrdTypeName(VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return "uint8";
    case VoxelType::kI16:
      return "int16";
    case VoxelType::kU16:
      return "uint16";
    case VoxelType::kF32:
      return "float";
  }
  throw std::logic_error{"voxel type out of range"};
}

bool needsSpace(const VolumeInfo& info) {
  return info.anatomical || !isPlainGrid(info.grid);
}

/// The format wants the space right behind the dimension, before any vector in it.
std::string_view spaceLine(const VolumeInfo& info) {
  if (!needsSpace(info)) return "";
  return info.anatomical ? "space: left-posterior-superior\n" : "space dimension: 3\n";
}

std::string orientation(const VolumeInfo& info) {
  const VolumeGrid& grid = info.grid;
  if (!needsSpace(info)) {
    return fmt::format("spacings: {} {} {}\n", grid.spacing.x, grid.spacing.y, grid.spacing.z);
  }
  std::string text = "space directions:";
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 step = grid.direction[axis] * grid.spacing[axis];
    text += fmt::format(" ({},{},{})", step.x, step.y, step.z);
  }
  return text +
         fmt::format("\nspace origin: ({},{},{})\n", grid.origin.x, grid.origin.y, grid.origin.z);
}

}  // namespace

bool isPlainGrid(const VolumeGrid& grid) {
  return grid.origin == glm::dvec3{0} && grid.direction == glm::dmat3{1};
}

std::string nrrdHeader(const VolumeInfo& info, bool gzip, std::string_view dataFile) {
  const glm::ivec3& dims = info.grid.dims;
  std::string text = fmt::format("NRRD0004\ntype: {}\ndimension: 3\n{}sizes: {} {} {}\n{}",
                                 nrrdTypeName(info.type), spaceLine(info), dims.x, dims.y, dims.z,
                                 orientation(info));
  text += fmt::format("endian: {}\nencoding: {}\n",
                      std::endian::native == std::endian::big ? "big" : "little",
                      gzip ? "gzip" : "raw");
  if (!dataFile.empty()) text += fmt::format("data file: {}\n", dataFile);
  return text + (dataFile.empty() ? "\n" : "");
}

}  // namespace burin::node
