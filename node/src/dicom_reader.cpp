// DICOM by GDCM: a folder with a series of slices, or one file with several frames.
#include "burin/common/error.hpp"
#include "dicom_series.hpp"
#include "file_formats.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

/// Slices in files of their own, each read whole by who wants a part of it; or the frames of one.
class DicomVoxels : public SliceReader {
 public:
  DicomVoxels(std::vector<DicomImage> images, const StoredLayout& layout)
      : images_{std::move(images)}, layout_{layout} {}

  const StoredLayout& layout() const override { return layout_; }

 private:
  void readSlice(const IndexBox& box, std::span<std::byte> out) override {
    const bool isFrame = images_.size() == 1;
    const DicomImage& image = images_[isFrame ? 0 : static_cast<std::size_t>(box.lo.z)];
    const int frame = isFrame ? box.lo.z : 0;
    readDicomPixels(image, {{box.lo.x, box.lo.y, frame}, {box.hi.x, box.hi.y, frame + 1}}, out);
  }

  std::vector<DicomImage> images_;
  StoredLayout layout_;
};

}  // namespace

bool recognisesDicom(const FileStart& start) {
  if (start.isFolder) return hasDicomFiles(start.path);
  return start.startsWith("DICM", 128) || start.nameEndsWith(".dcm");
}

std::unique_ptr<BrickSource> openDicom(const VolumeChoice& choice) {
  DicomSeries series = readDicomSeries(choice);
  const DicomImage& first = series.images.front();
  VolumeInfo info;
  info.name = choice.file;
  info.format = "DICOM";
  info.grid = series.grid;
  info.anatomical = series.anatomical;
  info.notice = series.notice;
  checkGrid(choice.file, info.grid);
  const StoredLayout layout{series.grid.dims, first.layout.type, first.layout.components};
  checkLayout(choice.file, layout);
  Conversion conversion;
  conversion.component = chosenComponent(choice, layout.components);
  conversion.storedRange = first.storedRange;
  conversion.rescale.clear();
  for (const DicomImage& image : series.images) {
    conversion.rescale.push_back(image.rescale);
    conversion.storedRange->x = std::min(conversion.storedRange->x, image.storedRange.x);
    conversion.storedRange->y = std::max(conversion.storedRange->y, image.storedRange.y);
  }
  const std::string encoding = first.encoding;
  auto voxels = std::make_unique<DicomVoxels>(std::move(series.images), layout);
  return std::make_unique<StoredSource>(std::move(info), std::move(voxels), std::move(conversion),
                                        encoding);
}

}  // namespace burin::node
