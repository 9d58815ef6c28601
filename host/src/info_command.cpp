#include <fmt/format.h>

#include <cstdio>

#include "build_info.hpp"
#include "burin/common/error.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/gradient_histogram.hpp"
#include "burin/host/histogram.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/host/picture.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/host/text.hpp"
#include "burin/node/label_volume.hpp"
#include "burin/node/survey.hpp"
#include "label_setup.hpp"

namespace burin::host {

namespace {

constexpr int kHistogramColumns = 64;
constexpr int kHistogramRows = 8;

std::string line(const char* label, const std::string& value) {
  return fmt::format("{:<13}{}\n", label, value);
}

std::string triple(const glm::dvec3& given) {
  const glm::dvec3 v = given + 0.0;  // makes 0 of -0
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

std::string byteCount(std::size_t bytes) {
  constexpr double kMebi = 1024.0 * 1024.0;
  const auto count = static_cast<double>(bytes);
  return count < kMebi ? fmt::format("{:.1f} KiB", count / 1024)
                       : fmt::format("{:.1f} MiB", count / kMebi);
}

std::string describeFile(const node::VolumeInfo& info) {
  const VolumeGrid& grid = info.grid;
  const glm::dvec3 size = glm::dvec3{grid.cells()} * grid.spacing;
  std::string format = info.format;
  if (!info.encoding.empty()) format += ", " + info.encoding;
  if (info.components > 1) format += fmt::format(", {} components per voxel", info.components);
  return line("volume", info.name) + line("format", format) +
         line("dimensions", fmt::format("{} x {} x {}", grid.dims.x, grid.dims.y, grid.dims.z)) +
         line("type",
              fmt::format("{}, {}", node::voxelTypeName(info.type), byteCount(info.bytes()))) +
         line("spacing", triple(grid.spacing)) + line("size", triple(size)) +
         line("origin", triple(grid.origin)) +
         line("orientation",
              fmt::format("x ({}), y ({}), z ({}), {}", triple(grid.direction[0]),
                          triple(grid.direction[1]), triple(grid.direction[2]),
                          info.anatomical ? "anatomical: world is left, posterior, superior"
                                          : "the file's own axes"));
}

std::string describeValues(const node::VolumeSurvey& survey) {
  const node::GradientScales& gradients = survey.gradients[GradientOperator::kCentral];
  return line("range", fmt::format("{:.7g} … {:.7g}", survey.lowest, survey.highest)) +
         line("not finite",
              fmt::format("{} NaN, {} infinite", survey.nanCount, survey.infiniteCount)) +
         line("gradient",
              fmt::format("{:.6g} per world unit at the 99.9th percentile, {:.6g} at most",
                          gradients.percentile, gradients.maximum));
}

/// What would keep the picture from being written is found before anything is read.
void checkPicture(const InfoOptions& options) {
  std::error_code unknown;
  if (std::filesystem::equivalent(options.volume, options.gradientHistogram, unknown))
    fail(ExitCode::kUsage, "--histogram2d {}: this would overwrite the volume",
         options.gradientHistogram.string());
  if (options.gradientHistogram.extension() != ".png")
    fail(ExitCode::kUsage, "--histogram2d {}: expected a name that ends in .png",
         options.gradientHistogram.string());
  checkFont();
  loadPictureEncoder();
}

/// Collective.
void writeGradientHistogram(const Communicator& comm, node::BrickSource& source,
                            const node::VolumeSurvey& survey, const std::filesystem::path& target) {
  const GradientHistogram histogram = computeGradientHistogram(comm, source, survey);
  onRoot(comm,
         [&] { deferInterrupts([&] { writePng(target, drawGradientHistogram(histogram), {}); }); });
}

/// Number, name and colour of each label that is described, and how many voxels have it.
std::string describeLabels(std::span<const LabelInfo> labels, const node::LabelSurvey& survey) {
  std::string text;
  for (const LabelInfo& label : labels) {
    const auto found = survey.voxels.find(label.value);
    text += line("label", fmt::format("{} \"{}\"{}, {} voxels", label.value, label.name,
                                      label.colour ? " " + label.colour->hex() : "",
                                      found == survey.voxels.end() ? 0 : found->second));
  }
  return text;
}

}  // namespace

int runCommand(const Communicator& comm, const InfoOptions& options) {
  if (options.isBuild) {
    std::fputs(buildInfo(comm).c_str(), stdout);
    return 0;
  }
  VolumeChoice choice;
  choice.file = options.volume;
  options.raw.applyTo(choice);
  const bool hasPicture = !options.gradientHistogram.empty();
  if (hasPicture) onRoot(comm, [&] { checkPicture(options); });
  const auto source = openTogether(comm, choice);
  const auto survey =
      node::surveyVolume(comm, *source, {GradientOperatorSet{GradientOperator::kCentral}});
  const std::vector<LabelInfo> labels = options.labelNames.empty()
                                            ? source->info().labels
                                            : labelDescriptions(comm, options.labelNames);
  const std::string labelText =
      labels.empty() ? "" : describeLabels(labels, node::surveyLabels(comm, *source));
  const Histogram histogram = computeHistogram(comm, *source, survey);
  if (hasPicture) writeGradientHistogram(comm, *source, survey, options.gradientHistogram);
  if (!comm.isRoot()) return 0;
  const std::string text = describeFile(source->info()) + describeValues(survey) + labelText +
                           "histogram    logarithmic\n" +
                           drawHistogram(histogram, kHistogramColumns, kHistogramRows);
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace burin::host
