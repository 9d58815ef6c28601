// DICOM by DCMTK: a folder with a series of slices, or one file with several frames.
#include "dicom_volume.hpp"

#include <algorithm>
#include <optional>

#include "burin/common/error.hpp"
#include "dicom_pixels.hpp"
#include "dicom_series.hpp"
#include "dicom_syntax.hpp"
#include "dicom_table.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// Slices in files of their own, each read whole by who wants a part of it; or the frames of one.
class DicomVoxels : public DecodedSlices {
 public:
  DicomVoxels(std::vector<DicomImage> images, const StoredLayout& layout)
      : images_{std::move(images)}, layout_{layout} {}

  const StoredLayout& layout() const override { return layout_; }

 private:
  void decodeSlice(int z, std::span<std::byte> out) override {
    const bool isFrame = images_.size() == 1;
    const std::size_t index = isFrame ? 0 : static_cast<std::size_t>(z);
    if (!open_ || openIndex_ != index) {
      open_.reset();
      open_.emplace(images_[index]);
      openIndex_ = index;
    }
    open_->readFrame(isFrame ? z : 0, out);
  }

  std::vector<DicomImage> images_;
  StoredLayout layout_;
  std::optional<DicomPixels> open_;
  std::size_t openIndex_ = 0;  ///< of the image that is open
};

Conversion conversionOf(const VolumeChoice& choice, const std::vector<DicomImage>& images,
                        const StoredLayout& layout) {
  Conversion conversion;
  conversion.component = chosenComponent(choice, layout.components);
  glm::dvec2 range = images.front().storedRange;
  conversion.rescale.clear();
  for (const DicomImage& image : images) {
    conversion.rescale.insert(conversion.rescale.end(), image.rescale.begin(), image.rescale.end());
    range = {std::min(range.x, image.storedRange.x), std::max(range.y, image.storedRange.y)};
  }
  conversion.storedRange = range;
  return conversion;
}

}  // namespace

std::string scanDicomVolume(const VolumeChoice& choice) {
  return writeDicomTable(findDicomSeries(choice));
}

std::unique_ptr<BrickSource> openDicomVolume(const VolumeChoice& choice, const std::string& scan) {
  DicomSeries series = arrangeDicomSeries(choice.file, readDicomTable(scan));
  VolumeInfo info;
  info.name = choice.file;
  info.format = "DICOM";
  info.grid = series.grid;
  info.anatomical = series.anatomical;
  info.notice = series.notice;
  checkGrid(choice.file, info.grid);
  const DicomImage& first = series.images.front();
  const StoredLayout layout{series.grid.dims, first.layout.type, first.layout.components};
  checkLayout(choice.file, layout);
  const std::string encoding = dicomEncoding(first);
  for (const DicomImage& image : series.images) dicomEncoding(image);  // throws
  Conversion conversion = conversionOf(choice, series.images, layout);
  auto voxels = std::make_unique<DicomVoxels>(std::move(series.images), layout);
  return std::make_unique<StoredSource>(std::move(info), std::move(voxels), std::move(conversion),
                                        encoding);
}

}  // namespace burin::node
