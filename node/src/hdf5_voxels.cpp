#include "hdf5_voxels.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"
#include "hdf5_dataset.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

StoredType typeOf(const std::string& name, const Hdf5Dataset& dataset) {
  const Hdf5Type type{H5Dget_type(dataset.get())};
  const H5T_class_t kind = H5Tget_class(type.get());
  const std::size_t bytes = H5Tget_size(type.get());
  if (kind == H5T_INTEGER) {
    const char* const sign = H5Tget_sign(type.get()) == H5T_SGN_2 ? "i" : "u";
    if (const auto named = storedTypeFromName(fmt::format("{}{}", sign, 8 * bytes))) return *named;
  }
  if (kind == H5T_FLOAT && bytes <= 4) return StoredType::kF32;  // halves too
  if (kind == H5T_FLOAT && bytes == 8) return StoredType::kF64;
  fail(ExitCode::kVolume, "{}: an HDF5 type of {} bytes that is not supported (expected {})", name,
       bytes, supportedTypeNames());
}

hid_t memoryType(StoredType type) {
  switch (type) {
    case StoredType::kU8:
      return H5T_NATIVE_UINT8;
    case StoredType::kI8:
      return H5T_NATIVE_INT8;
    case StoredType::kU16:
      return H5T_NATIVE_UINT16;
    case StoredType::kI16:
      return H5T_NATIVE_INT16;
    case StoredType::kU32:
      return H5T_NATIVE_UINT32;
    case StoredType::kI32:
      return H5T_NATIVE_INT32;
    case StoredType::kU64:
      return H5T_NATIVE_UINT64;
    case StoredType::kI64:
      return H5T_NATIVE_INT64;
    case StoredType::kF32:
      return H5T_NATIVE_FLOAT;
    case StoredType::kF64:
      return H5T_NATIVE_DOUBLE;
  }
  throw std::logic_error{"stored type out of range"};
}

std::string shapeText(const std::vector<hsize_t>& shape) {
  return shape.empty() ? "scalar" : fmt::format("{}", fmt::join(shape, " x "));
}

/// The dataset's dimensions, slowest first as HDF5 has them: z, y, x, and components if there are
/// four. Leading dimensions of 1 do not count.
struct VolumeShape {
  std::size_t leading = 0;
  glm::ivec3 dims{1};
  int components = 1;
};

VolumeShape volumeShape(const std::string& name, std::vector<hsize_t> shape) {
  const std::string text = shapeText(shape);
  VolumeShape volume;
  while (shape.size() > 3 && shape.front() == 1) {
    shape.erase(shape.begin());
    ++volume.leading;
  }
  if (shape.size() != 3 && shape.size() != 4) {
    fail(ExitCode::kVolume,
         "{}: {} (expected a volume with 3 dimensions, or 4 with components last)", name, text);
  }
  if (shape.size() == 4) {
    if (shape[3] < 1 || shape[3] > hsize_t{kMostComponents}) {
      fail(ExitCode::kVolume, "{}: {} (expected 1 to {} components)", name, text, kMostComponents);
    }
    volume.components = static_cast<int>(shape[3]);
  }
  const auto size = [&](std::size_t i) {
    return static_cast<std::int64_t>(std::min<hsize_t>(shape[i], std::numeric_limits<int>::max()));
  };
  volume.dims = checkedDims(name, {size(2), size(1), size(0)});
  return volume;
}

class Hdf5Voxels : public StoredReader {
 public:
  Hdf5Voxels(std::string name, Hdf5File file, Hdf5Dataset dataset, const VolumeShape& shape,
             StoredType type)
      : name_{std::move(name)},
        file_{std::move(file)},
        dataset_{std::move(dataset)},
        shape_{shape},
        rank_{hdf5Shape(dataset_).size()},
        layout_{shape.dims, type, shape.components} {}

  const StoredLayout& layout() const override { return layout_; }
  bool randomAccess() const override { return true; }

  void read(const IndexBox& region, std::span<std::byte> out) override {
    checkRead(layout_, region, out);
    if (region.empty()) return;
    std::vector<hsize_t> start(rank_, 0);
    std::vector<hsize_t> count(rank_, 1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = shape_.leading + static_cast<std::size_t>(2 - axis);
      start[at] = static_cast<hsize_t>(region.lo[axis]);
      count[at] = static_cast<hsize_t>(region.size()[axis]);
    }
    if (rank_ == shape_.leading + 4) count.back() = static_cast<hsize_t>(layout_.components);
    const Hdf5Space inFile{H5Dget_space(dataset_.get())};
    const Hdf5Space inMemory{H5Screate_simple(static_cast<int>(rank_), count.data(), nullptr)};
    const bool isRead = H5Sselect_hyperslab(inFile.get(), H5S_SELECT_SET, start.data(), nullptr,
                                            count.data(), nullptr) >= 0 &&
                        H5Dread(dataset_.get(), memoryType(layout_.type), inMemory.get(),
                                inFile.get(), H5P_DEFAULT, out.data()) >= 0;
    if (!isRead) fail(ExitCode::kVolume, "{}: cannot be read: {}", name_, hdf5Reason());
  }

 private:
  std::string name_;
  Hdf5File file_;
  Hdf5Dataset dataset_;
  VolumeShape shape_;
  std::size_t rank_;
  StoredLayout layout_;
};

}  // namespace

std::unique_ptr<StoredReader> makeHdf5Voxels(const std::string& name, Hdf5File file,
                                             Hdf5Dataset dataset) {
  const StoredType type = typeOf(name, dataset);
  const VolumeShape shape = volumeShape(name, hdf5Shape(dataset));
  checkLayout(name, {shape.dims, type, shape.components});
  return std::make_unique<Hdf5Voxels>(name, std::move(file), std::move(dataset), shape, type);
}

}  // namespace burin::node
