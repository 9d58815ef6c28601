// Slices as pictures, by OpenImageIO: the pages of a TIFF, numbered files, or a folder of them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "module_function.hpp"
#include "picture_file.hpp"
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

using Picture = std::unique_ptr<PictureFile>;

std::string oneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return std::string{trimmed(text)};
}

Picture openPicture(const fs::path& file) {
  // OpenImageIO has threads of its own, and so the module stays open.
  static auto* const open = reinterpret_cast<OpenPictureFile*>(
      moduleFunction(BURIN_PICTURE_FILES_MODULE, kOpenPictureFile));
  regularFileSize(file);
  std::string reason;
  Picture picture{open(file.string(), reason)};
  if (picture == nullptr) {
    fail(ExitCode::kVolume, "{}: bad picture: {}", file.string(), oneLine(reason));
  }
  return picture;
}

StoredLayout pageLayout(const fs::path& file, PictureFile& picture, int page) {
  const PageShape shape = picture.shape(page);
  const auto type = storedTypeFromName(shape.type);
  if (!type) {
    fail(ExitCode::kVolume, "{}: pixel type \"{}\" is not supported (expected {})", file.string(),
         shape.type, supportedTypeNames());
  }
  return {checkedDims(file.string(), {shape.width, shape.height, 1}), *type, shape.channels};
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

/// A page is decoded whole: OpenImageIO 2.4 delivers zeros for some rows of a page of doubles.
class PictureVoxels : public DecodedSlices {
 public:
  PictureVoxels(PictureStack stack, const StoredLayout& layout)
      : stack_{std::move(stack)}, layout_{layout} {}

  const StoredLayout& layout() const override { return layout_; }

 private:
  void decodeSlice(int z, std::span<std::byte> out) override {
    const fs::path& file = stack_.file(z);
    const int page = stack_.page(z);
    if (open_ == nullptr || openFile_ != file) {
      open_ = openPicture(file);
      openFile_ = file;
    }
    checkPage(file, page, pageLayout(file, *open_, page), layout_);
    const std::string reason = open_->read(page, out);
    if (reason.empty()) return;
    fail(ExitCode::kVolume, "{}: page {} cannot be read: {}", file.string(), page, oneLine(reason));
  }

  PictureStack stack_;
  StoredLayout layout_;
  Picture open_;
  fs::path openFile_;
};

PictureStack stackOf(const std::string& written) {
  PictureStack stack{pictureFiles(written)};
  if (stack.files.size() > 1) return stack;
  stack.pages = openPicture(stack.files.front())->pages();
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
void setSpacing(const std::string& name, PictureFile& picture, int pages, VolumeInfo& info) {
  const std::string description = picture.text("ImageDescription");
  if (!description.starts_with("ImageJ=")) return;
  const double images = imageJNumber(description, "images").value_or(pages);
  if (images > pages) {
    fail(ExitCode::kVolume,
         "{}: ImageJ says {} images, the file has {} pages (a stack of more than "
         "4 GB, whose other slices no TIFF reader finds: expected one saved as BigTIFF or as a "
         "sequence)",
         name, images, pages);
  }
  const double x = picture.number("XResolution");
  const double y = picture.number("YResolution");
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
  StoredLayout layout = pageLayout(stack.files.front(), *first, 0);
  layout.dims = checkedDims(choice.file, {layout.dims.x, layout.dims.y, stack.slices()});
  checkLayout(choice.file, layout);
  VolumeInfo info;
  info.name = choice.file;
  info.format = fmt::format("{} pictures", first->format());
  info.grid.dims = layout.dims;
  setSpacing(choice.file, *first, stack.slices(), info);
  checkGrid(choice.file, info.grid);
  Conversion conversion;
  conversion.component = chosenComponent(choice, layout.components);
  const std::string packing = first->text("compression");
  return std::make_unique<StoredSource>(
      std::move(info), std::make_unique<PictureVoxels>(std::move(stack), layout),
      std::move(conversion), packing.empty() || packing == "none" ? "raw" : packing);
}

}  // namespace burin::node
