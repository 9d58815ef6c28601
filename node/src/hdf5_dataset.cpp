#include "hdf5_dataset.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <span>
#include <utility>

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

/// For H5Pset_elink_cb: negative if where an external link leads, beside its file or from the
/// working directory, there is something that is no file.
herr_t refuseSpecialFiles(const char* parent, const char* /*group*/, const char* child,
                          const char* /*object*/, unsigned* /*flags*/, hid_t /*access*/,
                          void* /*data*/) {
  std::error_code error;
  for (const auto& place :
       {std::filesystem::path{parent}.parent_path() / child, std::filesystem::path{child}})
    if (std::filesystem::exists(place, error) && !std::filesystem::is_regular_file(place, error))
      return -1;
  return 0;
}

/// How datasets are opened: a link to a FIFO would be waited for, for ever.
Hdf5PropertyList checkedLinks() {
  Hdf5PropertyList access{H5Pcreate(H5P_DATASET_ACCESS)};
  H5Pset_elink_cb(access.get(), refuseSpecialFiles, nullptr);
  return access;
}

/// "/a, /b, /c ...": some of them, so that the message stays one line.
std::string listed(const std::vector<std::string>& paths) {
  constexpr std::size_t kMost = 8;
  const auto shown = std::span{paths}.first(std::min(paths.size(), kMost));
  return fmt::format("{}{}", fmt::join(shown, ", "), paths.size() > kMost ? " ..." : "");
}

/// A dataset by its file and path.
using Place = std::pair<std::string, std::string>;

std::string resolvedName(const std::filesystem::path& file) {
  std::error_code error;
  const auto name = std::filesystem::canonical(file, error);
  return error ? file.string() : name.string();
}

/// Throws unless all files and datasets that the dataset refers to are there. `path`: the virtual
/// datasets by which it was come to, itself last; HDF5 follows those that lead to themselves until
/// its stack ends.
void checkReferences(const std::string& name, const Hdf5Dataset& dataset, std::vector<Place>& path,
                     std::set<Place>& checked) {
  const Hdf5PropertyList created{H5Dget_create_plist(dataset.get())};
  const auto folder =
      std::filesystem::path{path.size() == 1 ? name : path.back().first}.parent_path();
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
    Place source{path.back().first, ""};
    if (std::string_view{text.data()} != ".") {
      checkDataFile(name, folder / text.data());
      source.first = resolvedName(folder / text.data());
    }
    if (H5Pget_virtual_dsetname(created.get(), i, text.data(), text.size()) < 0) continue;
    source.second = text.data();
    if (source.second.find('%') != std::string::npos) continue;  // a pattern of numbered ones
    if (!source.second.starts_with('/')) source.second.insert(0, "/");
    if (std::ranges::find(path, source) != path.end())
      fail(ExitCode::kVolume, "{}: virtual dataset {} is made of itself", name, source.second);
    if (!checked.insert(source).second) continue;
    const Hdf5File file{H5Fopen(source.first.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)};
    const Hdf5Dataset found{file.valid()
                                ? H5Dopen2(file.get(), source.second.c_str(), checkedLinks().get())
                                : hid_t{-1}};
    if (!found.valid())
      fail(ExitCode::kVolume, "{}: no dataset {} in {} (expected as a virtual one is made of it)",
           name, source.second, source.first);
    path.push_back(std::move(source));
    checkReferences(name, found, path, checked);
    path.pop_back();
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
  Hdf5Dataset dataset{H5Dopen2(file.get(), path.c_str(), checkedLinks().get())};
  if (!dataset.valid()) {
    const auto volumes = volumesIn(file);
    fail(ExitCode::kVolume, "{}: no dataset {} (expected {})", name.file, path,
         volumes.empty() ? "one with 3 dimensions, and there is none" : listed(volumes));
  }
  std::vector<Place> virtuals{{resolvedName(name.file), path.starts_with('/') ? path : "/" + path}};
  std::set<Place> checked;
  checkReferences(name.file, dataset, virtuals, checked);
  return dataset;
}

}  // namespace burin::node
