#include "fed_inputs.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "burin/common/colour_map.hpp"
#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/brick_source.hpp"
#include "raw_name.hpp"

namespace burin::test {
namespace {

std::string contentOf(const std::string& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// What was read is written, and read again: the same scene.
void readScene(const std::string& file) {
  const Scene scene = parseScene(contentOf(file), file);
  BURIN_CHECK(parseScene(writeScene(scene), file) == scene);
}

void readMap(const std::string& file) {
  transferFunctionFrom(readColourMap(file));
}

/// The first line of the file is the name.
void readRawName(const std::string& file) {
  const std::string content = contentOf(file);
  const auto name = node::parseRawName(content.substr(0, content.find('\n')));
  if (name) node::canonicalTypeName(name->type);
}

/// All of a small volume, the ends of a large one: a header may promise what fills no memory.
void readVolume(const std::string& file) {
  constexpr std::size_t kSmall = 1 << 20;
  VolumeChoice choice;
  choice.file = file;
  choice.component = 0;
  const auto source = node::openVolume(choice);
  const node::VolumeInfo& info = source->info();
  const glm::ivec3 dims = info.grid.dims;
  const glm::ivec3 most = info.bytes() <= kSmall ? dims : glm::min(dims, glm::ivec3{2});
  std::vector<std::byte> voxels(IndexBox{glm::ivec3{0}, most}.count() *
                                node::bytesPerVoxel(info.type));
  for (const glm::ivec3& lowest : {glm::ivec3{0}, dims - most})
    source->load({lowest, lowest + most}, voxels);
}

constexpr std::array<FedInput, 11> kInputs{{{"scene", ".json", readScene},
                                            {"raw_name", ".name", readRawName},
                                            {"paraview", ".json", readMap},
                                            {"slicer", ".vp", readMap},
                                            {"nrrd", ".nrrd", readVolume},
                                            {"nifti", ".nii", readVolume},
                                            {"metaimage", ".mha", readVolume},
                                            {"vtk", ".vtk", readVolume},
                                            {"vti", ".vti", readVolume},
                                            {"hdf5", ".h5", readVolume},
                                            {"dicom", ".dcm", readVolume}}};

}  // namespace

std::span<const FedInput> fedInputs() {
  return kInputs;
}

std::string feed(const FedInput& input, const std::string& file) {
  try {
    input.read(file);
    return "";
  } catch (const Error& error) {
    const std::string message = error.what();
    BURIN_CHECK(error.code() == ExitCode::kVolume || error.code() == ExitCode::kUsage);
    BURIN_CHECK(message.find('\n') == std::string::npos);
    BURIN_CHECK(!message.empty());
    return message;
  }
}

}  // namespace burin::test
