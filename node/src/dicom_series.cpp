#include "dicom_series.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "burin/common/error.hpp"
#include "dicom_folder.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

using Images = std::vector<DicomImage>;

/// All images below a folder, by the UID of their series.
std::map<std::string, Images> imagesIn(const fs::path& folder) {
  std::map<std::string, Images> series;
  forFilesBelow(folder, [&](const fs::path& file) {
    if (auto image = readDicomHeader(file)) series[image->seriesUid].push_back(std::move(*image));
    return true;
  });
  return series;
}

std::string listOf(const std::map<std::string, Images>& series) {
  std::string text;
  int number = 0;
  for (const auto& [uid, images] : series) {
    text +=
        fmt::format("{}{}: {} ({} image{}, {})", number == 0 ? "" : "; ", number + 1,
                    images.front().description, images.size(), images.size() == 1 ? "" : "s", uid);
    ++number;
  }
  return text;
}

/// The one that the user chose by UID or by its number in the list.
Images chosenSeries(const VolumeChoice& choice, std::map<std::string, Images> series) {
  if (series.empty()) fail(ExitCode::kVolume, "{}: a folder without DICOM images", choice.file);
  if (!choice.series) {
    if (series.size() == 1) return std::move(series.begin()->second);
    fail(ExitCode::kVolume, "{}: {} DICOM series (expected one: choose with --series N or UID): {}",
         choice.file, series.size(), listOf(series));
  }
  const auto byUid = series.find(*choice.series);
  if (byUid != series.end()) return std::move(byUid->second);
  const auto number = numberIn<std::size_t>(*choice.series);
  if (!number || *number < 1 || *number > series.size()) {
    fail(ExitCode::kUsage, "{}: --series {} (expected one of {})", choice.file, *choice.series,
         listOf(series));
  }
  return std::move(std::next(series.begin(), static_cast<std::ptrdiff_t>(*number) - 1)->second);
}

/// Directions are cosines with six digits or so; a patient's slices agree better than this.
bool isSame(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(a, b) <= 1e-3;
}

void checkAlike(const std::string& name, const Images& images) {
  const DicomImage& first = images.front();
  for (const DicomImage& image : images) {
    const bool isAlike = image.layout.dims == first.layout.dims &&
                         image.layout.type == first.layout.type &&
                         image.layout.components == first.layout.components;
    if (!isAlike) {
      fail(ExitCode::kVolume, "{}: slices of one series differ: {} has {}, {} has {}", name,
           first.file.filename().string(), describe(first.layout), image.file.filename().string(),
           describe(image.layout));
    }
    const bool isParallel =
        image.position.has_value() == first.position.has_value() &&
        image.row.has_value() == first.row.has_value() &&
        (!first.row || (isSame(*image.row, *first.row) && isSame(*image.column, *first.column)));
    if (!isParallel) {
      fail(ExitCode::kVolume, "{}: slices of one series are not parallel: {} and {}", name,
           first.file.filename().string(), image.file.filename().string());
    }
  }
}

/// Distances from each slice to the next along the normal have to be one number.
void checkSteps(const std::string& name, const Images& images, const glm::dvec3& normal) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < images.size(); ++i)
    steps.push_back(glm::dot(normal, *images[i].position - *images[i - 1].position));
  std::vector<double> sorted = steps;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // Positions are written with two or three digits behind the point.
    const double tolerance = 0.02 * usual + std::min(0.011, usual / 4);
    if (steps[i] > 0 && std::abs(steps[i] - usual) <= tolerance) continue;
    const std::string which = fmt::format("{} and {}", images[i].file.filename().string(),
                                          images[i + 1].file.filename().string());
    if (steps[i] <= usual / 100) {
      fail(ExitCode::kVolume,
           "{}: two slices at one position: {} (expected one; several volumes in "
           "one series?)",
           name, which);
    }
    fail(ExitCode::kVolume,
         "{}: {} mm between slices {}, {} mm elsewhere (expected the same: slices "
         "are missing)",
         name, steps[i], which, usual);
  }
}

/// The direction of z and its spacing, from the positions of the first and the last slice. In a
/// scanner with a tilted gantry it is not the normal of the slices, and the grid is a sheared one.
void setThirdAxis(const std::string& name, const glm::dvec3& way, int steps,
                  const glm::dvec3& normal, DicomSeries& series) {
  const double length = glm::length(way);
  series.grid.spacing.z = length / steps;
  series.grid.direction[2] = way / length;
  const double cosine = std::abs(glm::dot(series.grid.direction[2], normal));
  const double tilt = glm::degrees(std::acos(std::min(cosine, 1.0)));
  constexpr double kNoticed = 0.5;  // degrees; below it is rounding of the positions
  if (tilt > kNoticed) {
    series.notice = fmt::format(
        "{}: slices are shifted against one another (gantry tilt of {:.1f} degrees); "
        "they are drawn where they were taken",
        name, tilt);
  }
}

/// Every slice has to lie where a straight line from the first to the last has it.
void checkLine(const std::string& name, const Images& images, const VolumeGrid& grid) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const glm::dvec3 expected =
        grid.origin + grid.direction[2] * (grid.spacing.z * static_cast<double>(i));
    const double tolerance = 0.02 * grid.spacing.z + std::min(0.05, grid.spacing.z / 4);
    if (glm::distance(expected, *images[i].position) <= tolerance) continue;
    fail(ExitCode::kVolume, "{}: slice {} is off the line of the others (expected one volume)",
         name, images[i].file.filename().string());
  }
}

/// Sorts by position; nothing to sort by is said.
void sortSlices(const std::string& name, const glm::dvec3& normal, DicomSeries& series) {
  const bool hasPositions = series.images.front().position.has_value();
  std::ranges::stable_sort(series.images, [&](const DicomImage& a, const DicomImage& b) {
    if (!hasPositions) return std::pair{a.instance, a.file} < std::pair{b.instance, b.file};
    return glm::dot(normal, *a.position) < glm::dot(normal, *b.position);
  });
  if (!hasPositions && series.images.size() > 1) {
    series.notice =
        fmt::format("{}: slices without positions, taken in the order of their numbers", name);
  }
}

}  // namespace

DicomSeries arrangeDicomSeries(const std::string& name, std::vector<DicomImage> images) {
  DicomSeries series;
  series.images = std::move(images);
  checkAlike(name, series.images);
  const DicomImage first = series.images.front();
  const int frames = first.layout.dims.z;
  if (frames > 1 && series.images.size() > 1) {
    fail(ExitCode::kVolume, "{}: {} files of one series with {} frames each (expected one)", name,
         series.images.size(), frames);
  }
  const glm::dvec3 row = first.row.value_or(glm::dvec3{1, 0, 0});
  const glm::dvec3 column = first.column.value_or(glm::dvec3{0, 1, 0});
  if (!(glm::length(glm::cross(row, column)) > 1e-3)) {
    fail(ExitCode::kVolume, "{}: rows and columns of {} have one direction (expected two)", name,
         first.file.filename().string());
  }
  const glm::dvec3 normal = glm::normalize(glm::cross(row, column));
  sortSlices(name, normal, series);
  const int slices = std::max(frames, static_cast<int>(series.images.size()));
  series.grid.dims = {first.layout.dims.x, first.layout.dims.y, slices};
  series.grid.direction = {glm::normalize(row), glm::normalize(column), normal};
  series.grid.spacing = {first.spacing, first.sliceSpacing.value_or(1)};
  const DicomImage& lowest = series.images.front();
  series.anatomical = lowest.position.has_value() && first.row.has_value();
  series.grid.origin = lowest.position.value_or(glm::dvec3{0});
  if (series.anatomical && series.images.size() > 1) {
    checkSteps(name, series.images, normal);
    setThirdAxis(name, *series.images.back().position - series.grid.origin, slices - 1, normal,
                 series);
    checkLine(name, series.images, series.grid);
  } else if (series.anatomical && frames > 1 && first.lastFrame &&
             !isSame(*first.lastFrame, series.grid.origin)) {
    setThirdAxis(name, *first.lastFrame - series.grid.origin, frames - 1, normal, series);
  }
  return series;
}

std::vector<DicomImage> findDicomSeries(const VolumeChoice& choice) {
  if (fs::is_directory(choice.file)) return chosenSeries(choice, imagesIn(choice.file));
  auto image = readDicomHeader(choice.file);
  if (!image) fail(ExitCode::kVolume, "{}: not a DICOM file with an image", choice.file);
  return {std::move(*image)};
}

}  // namespace burin::node
