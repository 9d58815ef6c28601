// Slices as pictures, by OpenImageIO: the pages of a TIFF, numbered files, or a folder of them.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "picture_files.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

/// Slices: the pages of one file, or the first page of each of several.
struct PictureStack {
  std::vector<fs::path> files;
  int pages = 1;  ///< of the one file

  int slices() const { return files.size() == 1 ? pages : static_cast<int>(files.size()); }
  const fs::path& file(int z) const {
    return files[files.size() == 1 ? 0 : static_cast<std::size_t>(z)];
  }
  int page(int z) const { return files.size() == 1 ? z : 0; }
};

using Picture = std::unique_ptr<OIIO::ImageInput>;

std::string oneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return std::string{trimmed(text)};
}

Picture openPicture(const fs::path& file) {
  regularFileSize(file);
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);  // numbers as they are stored
  Picture picture = OIIO::ImageInput::open(file.string(), &wanted);
  if (picture == nullptr) {
    fail(ExitCode::kVolume, "{}: bad picture: {}", file.string(), oneLine(OIIO::geterror()));
  }
  return picture;
}

constexpr std::pair<OIIO::TypeDesc::BASETYPE, StoredType> kPixelTypes[] = {
    {OIIO::TypeDesc::UINT8, StoredType::kU8},   {OIIO::TypeDesc::INT8, StoredType::kI8},
    {OIIO::TypeDesc::UINT16, StoredType::kU16}, {OIIO::TypeDesc::INT16, StoredType::kI16},
    {OIIO::TypeDesc::UINT32, StoredType::kU32}, {OIIO::TypeDesc::INT32, StoredType::kI32},
    {OIIO::TypeDesc::FLOAT, StoredType::kF32},  {OIIO::TypeDesc::DOUBLE, StoredType::kF64},
    {OIIO::TypeDesc::HALF, StoredType::kF32}};

StoredType typeOf(const fs::path& file, const OIIO::TypeDesc& format) {
  for (const auto& [theirs, ours] : kPixelTypes) {
    if (theirs == format.basetype) return ours;
  }
  fail(ExitCode::kVolume, "{}: pixel type \"{}\" is not supported (expected {})", file.string(),
       format.c_str(), supportedTypeNames());
}

OIIO::TypeDesc memoryType(StoredType type) {
  for (const auto& [theirs, ours] : kPixelTypes) {
    if (ours == type) return theirs;
  }
  throw std::logic_error{"no pixel has this type"};
}

StoredLayout pageLayout(const fs::path& file, const OIIO::ImageSpec& spec) {
  return {checkedDims(file.string(), {spec.width, spec.height, 1}), typeOf(file, spec.format),
          spec.nchannels};
}

/// Throws unless a page is like the first one.
void checkPage(const fs::path& file, int page, const StoredLayout& found,
               const StoredLayout& layout) {
  StoredLayout expected = layout;
  expected.dims.z = 1;
  if (describe(found) == describe(expected)) return;
  fail(ExitCode::kVolume, "{}: page {} has {} ({} expected)", file.string(), page, describe(found),
       describe(expected));
}

class PictureVoxels : public SliceReader {
 public:
  PictureVoxels(PictureStack stack, const StoredLayout& layout)
      : stack_{std::move(stack)}, layout_{layout} {}

  const StoredLayout& layout() const override { return layout_; }

 private:
  /// The page is decoded whole: OpenImageIO 2.4 delivers zeros for some rows of a page of doubles.
  void readSlice(const IndexBox& slice, std::span<std::byte> out) override {
    const int z = slice.lo.z;
    const IndexBox page{{0, 0, z}, {layout_.dims.x, layout_.dims.y, z + 1}};
    if (decoded_ != z) {
      decoded_ = -1;
      scratch_.resize(page.count() * layout_.voxelBytes());
      decode(stack_.file(z), stack_.page(z));
      decoded_ = z;
    }
    copyVoxels(scratch_, page, out, slice, slice, layout_.voxelBytes());
  }

  void decode(const fs::path& file, int page) {
    if (open_ == nullptr || openFile_ != file) {
      open_ = openPicture(file);
      openFile_ = file;
    }
    const OIIO::ImageSpec spec = open_->spec_dimensions(page);
    checkPage(file, page, pageLayout(file, spec), layout_);
    if (!open_->read_image(page, 0, 0, spec.nchannels, memoryType(layout_.type), scratch_.data())) {
      fail(ExitCode::kVolume, "{}: page {} cannot be read: {}", file.string(), page,
           oneLine(open_->geterror()));
    }
  }

  PictureStack stack_;
  StoredLayout layout_;
  Picture open_;
  fs::path openFile_;
  std::vector<std::byte> scratch_;
  int decoded_ = -1;  ///< the slice in scratch_
};

PictureStack stackOf(const std::string& written) {
  PictureStack stack{pictureFiles(written)};
  if (stack.files.size() > 1) return stack;
  const Picture picture = openPicture(stack.files.front());
  while (picture->seek_subimage(stack.pages, 0)) ++stack.pages;
  if (stack.pages > 1) return stack;
  fail(ExitCode::kVolume,
       "{}: one picture is no volume (expected a TIFF of several pages, a name like "
       "slice%03d.png for numbered ones, or their folder)",
       stack.files.front().string());
}

/// The number behind "key=" in ImageJ's description of a stack.
std::optional<double> imageJNumber(std::string_view description, std::string_view key) {
  for (std::size_t at = 0; at < description.size();) {
    const std::size_t end = std::min(description.find('\n', at), description.size());
    const std::string_view line = trimmed(description.substr(at, end - at));
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == '=')
      return numberIn<double>(line.substr(key.size() + 1));
    at = end + 1;
  }
  return std::nullopt;
}

/// ImageJ keeps pixels per unit as the resolution, and the distance of slices in the description.
void setSpacing(const std::string& name, const OIIO::ImageSpec& spec, int pages, VolumeInfo& info) {
  const std::string description = spec.get_string_attribute("ImageDescription");
  if (!description.starts_with("ImageJ=")) return;
  const double images = imageJNumber(description, "images").value_or(pages);
  if (images > pages) {
    fail(ExitCode::kVolume,
         "{}: ImageJ says {} images, the file has {} pages (a stack of more than "
         "4 GB, whose other slices no TIFF reader finds: expected one saved as BigTIFF or as a "
         "sequence)",
         name, images, pages);
  }
  const double x = spec.get_float_attribute("XResolution", 0);
  const double y = spec.get_float_attribute("YResolution", 0);
  const double z = imageJNumber(description, "spacing").value_or(1);
  if (x > 0 && y > 0) info.grid.spacing = {1 / x, 1 / y, std::abs(z)};
}

}  // namespace

bool recognisesPictures(const FileStart& start) {
  if (start.isFolder) return !picturesIn(start.path).empty();
  return isPictureName(start.lowerName);
}

std::unique_ptr<BrickSource> openPictures(const VolumeChoice& choice) {
  PictureStack stack = stackOf(choice.file);
  const Picture first = openPicture(stack.files.front());
  const OIIO::ImageSpec spec = first->spec(0);
  StoredLayout layout = pageLayout(stack.files.front(), spec);
  layout.dims = checkedDims(choice.file, {layout.dims.x, layout.dims.y, stack.slices()});
  checkLayout(choice.file, layout);
  VolumeInfo info;
  info.name = choice.file;
  info.format = fmt::format("{} pictures", first->format_name());
  info.grid.dims = layout.dims;
  setSpacing(choice.file, spec, stack.slices(), info);
  checkGrid(choice.file, info.grid);
  Conversion conversion;
  conversion.component = chosenComponent(choice, layout.components);
  const std::string packing = spec.get_string_attribute("compression", "raw");
  return std::make_unique<StoredSource>(std::move(info),
                                        std::make_unique<PictureVoxels>(std::move(stack), layout),
                                        std::move(conversion), packing == "none" ? "raw" : packing);
}

}  // namespace burin::node
