#include "hdf5_dataset.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>

#include "burin/common/error.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// Datasets of three or more dimensions, by path.
std::vector<std::string> volumesIn(const Hdf5File& file) {
  std::vector<std::string> found;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const Hdf5Dataset dataset{H5Dopen2(root, name, H5P_DEFAULT)};
    if (dataset.valid() && hdf5Shape(dataset).size() >= 3) {
      static_cast<std::vector<std::string>*>(out)->push_back(std::string{"/"} + name);
    }
    return 0;
  };
  H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, visit, &found, H5O_INFO_BASIC);
  return found;
}

/// "/a, /b, /c ...": some of them, so that the message stays one line.
std::string listed(const std::vector<std::string>& paths) {
  constexpr std::size_t kMost = 8;
  const auto shown = std::span{paths}.first(std::min(paths.size(), kMost));
  return fmt::format("{}{}", fmt::join(shown, ", "), paths.size() > kMost ? " ..." : "");
}

/// Throws unless all files that the dataset refers to are there.
void checkOtherFiles(const std::string& name, const Hdf5Dataset& dataset) {
  const Hdf5PropertyList created{H5Dget_create_plist(dataset.get())};
  const auto folder = std::filesystem::path{name}.parent_path();
  std::array<char, 4096> text{};
  const int externals = H5Pget_external_count(created.get());
  for (int i = 0; i < externals; ++i) {
    if (H5Pget_external(created.get(), static_cast<unsigned>(i), text.size() - 1, text.data(),
                        nullptr, nullptr) >= 0)
      checkDataFile(name, text.data());  // HDF5 takes it relative to the working directory
  }
  if (H5Pget_layout(created.get()) != H5D_VIRTUAL) return;
  std::size_t sources = 0;
  H5Pget_virtual_count(created.get(), &sources);
  for (std::size_t i = 0; i < sources; ++i) {
    if (H5Pget_virtual_filename(created.get(), i, text.data(), text.size()) < 0) continue;
    if (std::string_view{text.data()} != ".") checkDataFile(name, folder / text.data());
  }
}

}  // namespace

Hdf5File openHdf5File(const std::string& name) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // it prints a page for each failure; ours say it
  regularFileSize(name);
  Hdf5File file{H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)};
  if (!file.valid()) fail(ExitCode::kVolume, "{}: bad HDF5 file: {}", name, hdf5Reason());
  return file;
}

std::vector<hsize_t> hdf5Shape(const Hdf5Dataset& dataset) {
  const Hdf5Space space{H5Dget_space(dataset.get())};
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.get()) : 0;
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (!shape.empty()) H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  return shape;
}

Hdf5Dataset openHdf5Dataset(const Hdf5File& file, const Hdf5Name& name) {
  std::string path = name.path;
  if (path.empty()) {
    const auto volumes = volumesIn(file);
    if (volumes.size() != 1) {
      fail(ExitCode::kVolume, "{}: {} datasets with 3 dimensions (expected {}:/PATH of {})",
           name.file, volumes.size(), name.file, volumes.empty() ? "one" : listed(volumes));
    }
    path = volumes.front();
  }
  Hdf5Dataset dataset{H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT)};
  if (!dataset.valid()) {
    const auto volumes = volumesIn(file);
    fail(ExitCode::kVolume, "{}: no dataset {} (expected {})", name.file, path,
         volumes.empty() ? "one with 3 dimensions, and there is none" : listed(volumes));
  }
  checkOtherFiles(name.file, dataset);
  return dataset;
}

}  // namespace burin::node
