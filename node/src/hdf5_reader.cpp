// HDF5 datasets, named FILE:/path/of/the/dataset; each rank reads its own hyperslabs.
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <utility>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// An HDF5 identifier and the function that closes it. Move-only.
template <auto Close>
class Hdf5Id {
 public:
  explicit Hdf5Id(hid_t id) noexcept : id_{id} {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_{std::exchange(other.id_, hid_t{-1})} {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Id() {
    if (id_ >= 0) Close(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
};
using File = Hdf5Id<H5Fclose>;
using Dataset = Hdf5Id<H5Dclose>;
using Space = Hdf5Id<H5Sclose>;
using Type = Hdf5Id<H5Tclose>;
using Attribute = Hdf5Id<H5Aclose>;
using PropertyList = Hdf5Id<H5Pclose>;

/// HDF5's own reason for the last failure: the innermost of its messages.
std::string hdf5Reason() {
  std::string reason = "unknown reason";
  const auto keep = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
    if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &reason);
  std::ranges::replace(reason, '\n', ' ');
  return reason;
}

/// "file.h5" and "/path" of what the user wrote; the path is empty if there is none.
struct Hdf5Name {
  std::string file;
  std::string path;
};

Hdf5Name splitName(const std::string& written) {
  const std::size_t colon = written.rfind(":/");
  std::error_code ignored;
  if (colon == std::string::npos || std::filesystem::exists(written, ignored)) return {written, ""};
  return {written.substr(0, colon), written.substr(colon + 1)};
}

File openFile(const std::string& name) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // it prints a page for each failure; ours say it
  regularFileSize(name);
  File file{H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)};
  if (!file.valid()) fail(ExitCode::kVolume, "{}: bad HDF5 file: {}", name, hdf5Reason());
  return file;
}

std::vector<hsize_t> shapeOf(hid_t dataset) {
  const Space space{H5Dget_space(dataset)};
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.get()) : 0;
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (!shape.empty()) H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  return shape;
}

std::string shapeText(const std::vector<hsize_t>& shape) {
  return shape.empty() ? "scalar" : fmt::format("{}", fmt::join(shape, " x "));
}

/// Datasets of three or more dimensions, by path.
std::vector<std::string> volumesIn(const File& file) {
  std::vector<std::string> found;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const Dataset dataset{H5Dopen2(root, name, H5P_DEFAULT)};
    if (dataset.valid() && shapeOf(dataset.get()).size() >= 3) {
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

Dataset openDataset(const File& file, const Hdf5Name& name) {
  std::string path = name.path;
  if (path.empty()) {
    const auto volumes = volumesIn(file);
    if (volumes.size() != 1) {
      fail(ExitCode::kVolume, "{}: {} datasets with 3 dimensions (expected {}:/PATH of {})",
           name.file, volumes.size(), name.file, volumes.empty() ? "one" : listed(volumes));
    }
    path = volumes.front();
  }
  Dataset dataset{H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT)};
  if (!dataset.valid()) {
    const auto volumes = volumesIn(file);
    fail(ExitCode::kVolume, "{}: no dataset {} (expected {})", name.file, path,
         volumes.empty() ? "one with 3 dimensions, and there is none" : listed(volumes));
  }
  return dataset;
}

/// Throws unless all files that the dataset refers to are there: HDF5 delivers fill values for some
/// that are missing, and waits for ever at a FIFO.
void checkOtherFiles(const std::string& name, const Dataset& dataset) {
  const PropertyList created{H5Dget_create_plist(dataset.get())};
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

StoredType typeOf(const std::string& name, const Dataset& dataset) {
  const Type type{H5Dget_type(dataset.get())};
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

/// The dataset's dimensions, slowest first as HDF5 has them: z, y, x, and components if there are
/// four. Leading dimensions of 1 do not count.
struct Hdf5Shape {
  std::size_t leading = 0;
  glm::ivec3 dims{1};
  int components = 1;
};

Hdf5Shape volumeShape(const std::string& name, std::vector<hsize_t> shape) {
  const std::string text = shapeText(shape);
  Hdf5Shape volume;
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

/// Voxels of a dataset. Chunks, compressed or not, are HDF5's business: any region at its own cost.
class Hdf5Voxels : public StoredReader {
 public:
  Hdf5Voxels(std::string name, File file, Dataset dataset, const Hdf5Shape& shape, StoredType type)
      : name_{std::move(name)},
        file_{std::move(file)},
        dataset_{std::move(dataset)},
        shape_{shape},
        rank_{shapeOf(dataset_.get()).size()},
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
    const Space inFile{H5Dget_space(dataset_.get())};
    const Space inMemory{H5Screate_simple(static_cast<int>(rank_), count.data(), nullptr)};
    const bool isRead = H5Sselect_hyperslab(inFile.get(), H5S_SELECT_SET, start.data(), nullptr,
                                            count.data(), nullptr) >= 0 &&
                        H5Dread(dataset_.get(), memoryType(layout_.type), inMemory.get(),
                                inFile.get(), H5P_DEFAULT, out.data()) >= 0;
    if (!isRead) fail(ExitCode::kVolume, "{}: cannot be read: {}", name_, hdf5Reason());
  }

 private:
  std::string name_;
  File file_;
  Dataset dataset_;
  Hdf5Shape shape_;
  std::size_t rank_;
  StoredLayout layout_;
};

/// Three numbers of an attribute, slowest dimension first; nothing if it is not there.
std::optional<std::array<double, 3>> threeNumbers(const Dataset& dataset, const char* name) {
  if (H5Aexists(dataset.get(), name) <= 0) return std::nullopt;
  const Attribute attribute{H5Aopen(dataset.get(), name, H5P_DEFAULT)};
  const Space space{H5Aget_space(attribute.get())};
  const Type type{H5Aget_type(attribute.get())};
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
void setSpacing(const Dataset& dataset, VolumeInfo& info) {
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
std::string encodingOf(const Dataset& dataset) {
  const PropertyList created{H5Dget_create_plist(dataset.get())};
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

bool recognisesHdf5(const FileStart& start) {
  using std::string_view_literals::operator""sv;
  return start.startsWith("\x89HDF\r\n\x1a\n"sv) || start.nameEndsWith(".h5") ||
         start.nameEndsWith(".hdf5");
}

std::string hdf5File(const std::string& written) {
  return splitName(written).file;
}

std::unique_ptr<BrickSource> openHdf5(const VolumeChoice& choice) {
  const Hdf5Name name = splitName(choice.file);
  File file = openFile(name.file);
  Dataset dataset = openDataset(file, name);
  checkOtherFiles(name.file, dataset);
  const StoredType type = typeOf(choice.file, dataset);
  const Hdf5Shape shape = volumeShape(choice.file, shapeOf(dataset.get()));
  VolumeInfo info;
  info.name = choice.file;
  info.format = "HDF5";
  info.grid.dims = shape.dims;
  setSpacing(dataset, info);
  checkGrid(choice.file, info.grid);
  const std::string encoding = encodingOf(dataset);
  Conversion conversion;
  conversion.component = chosenComponent(choice, shape.components);
  checkLayout(choice.file, {shape.dims, type, shape.components});
  auto voxels =
      std::make_unique<Hdf5Voxels>(choice.file, std::move(file), std::move(dataset), shape, type);
  return std::make_unique<StoredSource>(std::move(info), std::move(voxels), std::move(conversion),
                                        encoding);
}

}  // namespace burin::node
