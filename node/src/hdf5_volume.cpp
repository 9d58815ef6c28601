// HDF5 datasets, named FILE:/path/of/the/dataset; each rank reads its own hyperslabs.
#include "hdf5_volume.hpp"

#include <array>
#include <optional>

#include "burin/common/error.hpp"
#include "hdf5_dataset.hpp"
#include "hdf5_voxels.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// Three numbers of an attribute, slowest dimension first; nothing if it is not there.
std::optional<std::array<double, 3>> threeNumbers(const Hdf5Dataset& dataset, const char* name) {
  if (H5Aexists(dataset.get(), name) <= 0) return std::nullopt;
  const Hdf5Attribute attribute{H5Aopen(dataset.get(), name, H5P_DEFAULT)};
  const Hdf5Space space{H5Aget_space(attribute.get())};
  const Hdf5Type type{H5Aget_type(attribute.get())};
  const H5T_class_t kind = H5Tget_class(type.get());
  std::array<double, 3> numbers{};
  if (H5Sget_simple_extent_npoints(space.get()) != 3 ||
      (kind != H5T_FLOAT && kind != H5T_INTEGER) ||
      H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, numbers.data()) < 0)
    return std::nullopt;
  return numbers;
}

/// Two conventions: "element_size_um" (ImageJ's HDF5 plug-in, ilastik, PlantSeg: z, y, x) and
/// "spacing" with "origin" beside it in the same order, as h5py scripts write them.
void setSpacing(const Hdf5Dataset& dataset, VolumeInfo& info) {
  auto spacing = threeNumbers(dataset, "element_size_um");
  if (!spacing) spacing = threeNumbers(dataset, "spacing");
  const auto origin = threeNumbers(dataset, "origin");
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(2 - axis);
    if (spacing) info.grid.spacing[axis] = (*spacing)[at];
    if (origin) info.grid.origin[axis] = (*origin)[at];
  }
}

/// "chunks, gzip": how the dataset lies in the file.
std::string encodingOf(const Hdf5Dataset& dataset) {
  const Hdf5PropertyList created{H5Dget_create_plist(dataset.get())};
  if (H5Pget_layout(created.get()) != H5D_CHUNKED) return "raw";
  std::string text = "chunked";
  const int filters = H5Pget_nfilters(created.get());
  for (int i = 0; i < filters; ++i) {
    std::array<char, 64> name{};
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t values = 0;
    H5Pget_filter2(created.get(), static_cast<unsigned>(i), &flags, &values, nullptr,
                   name.size() - 1, name.data(), &config);
    text += fmt::format(" {}", name.data());
  }
  return text;
}

}  // namespace

std::unique_ptr<BrickSource> openHdf5Volume(const VolumeChoice& choice) {
  const Hdf5Name name = splitHdf5Name(choice.file);
  Hdf5File file = openHdf5File(name.file);
  Hdf5Dataset dataset = openHdf5Dataset(file, name);
  VolumeInfo info;
  info.name = choice.file;
  info.format = "HDF5";
  setSpacing(dataset, info);
  const std::string encoding = encodingOf(dataset);
  auto voxels = makeHdf5Voxels(choice.file, std::move(file), std::move(dataset));
  info.grid.dims = voxels->layout().dims;
  checkGrid(choice.file, info.grid);
  Conversion conversion;
  conversion.component = chosenComponent(choice, voxels->layout().components);
  return std::make_unique<StoredSource>(std::move(info), std::move(voxels), std::move(conversion),
                                        encoding);
}

}  // namespace burin::node
