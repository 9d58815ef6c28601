#include "label_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/node/survey.hpp"
#include "first_view.hpp"

namespace burin::host {

namespace {

/// Optical depth of a cube of a label's volume.
constexpr double kDepth = 3;

struct LabelShare {
  int label;
  double voxels;
};

/// Those that occur, most voxels first; 0 is what belongs to none.
std::vector<LabelShare> sharesOf(const node::LabelSurvey& survey) {
  std::vector<LabelShare> shares;
  for (const auto& [label, voxels] : survey.voxels)
    if (label != 0) shares.push_back({label, static_cast<double>(voxels)});
  std::ranges::stable_sort(shares, std::ranges::greater{}, &LabelShare::voxels);
  return shares;
}

/// Colours that are told apart side by side, for labels without one.
Colour paletteColour(int label) {
  constexpr std::array<std::string_view, 12> kPalette{"#d8a27c", "#f2e6c8", "#c9627a", "#5b8fc7",
                                                      "#d1a13a", "#6aa86b", "#9a76b8", "#c96b3c",
                                                      "#4fa7a2", "#b4b04a", "#a85f8f", "#7c8fa3"};
  const auto index = static_cast<std::size_t>(std::abs(label) - 1) % kPalette.size();
  return parseColour(kPalette[index]);
}

Layer layerOf(const LabelShare& share, std::span<const LabelInfo> infos, const VolumeGrid& grid) {
  const auto info = std::ranges::find(infos, share.label, &LabelInfo::value);
  const bool isKnown = info != infos.end();
  Layer layer;
  layer.name = isKnown && !info->name.empty() ? info->name : fmt::format("label {}", share.label);
  layer.labels = {share.label};
  const Colour colour = isKnown && info->colour ? *info->colour : paletteColour(share.label);
  const double side = std::cbrt(share.voxels * grid.spacing.x * grid.spacing.y * grid.spacing.z);
  const double unit = 2 * grid.boundingRadius() / 256;
  layer.transferFunction = {{{0, colour, -std::expm1(-kDepth * unit / side)}}, unit};
  for (const char* style : {"light", "edges"})
    layer.styles.push_back(defaultSettings(*findStyle(style)));
  return layer;
}

/// firstView() of all that has a label.
CameraChoice viewOfLabels(const Scene& scene, const VolumeFacts& facts,
                          const node::LabelSurvey& survey) {
  node::BlockRanges blocks;
  blocks.blockCells = node::blockCellsFor(facts.grid.dims);
  blocks.blocks = (facts.grid.cells() + blocks.blockCells - 1) / blocks.blockCells;
  for (const node::LabelSet set : survey.blocks) {
    blocks.lowest.push_back(0);
    blocks.highest.push_back((set & ~node::labelSet(0)) != 0 ? 1.0f : 0.0f);
  }
  Scene shown = scene;
  shown.layers.resize(1);
  shown.layers[0].transferFunction.points = {{0.4, {}, 0}, {0.6, {}, 1}};
  return firstView(shown, facts, blocks);
}

}  // namespace

Scene makeLabelScene(const VolumeChoice& volume, const LabelVolumeChoice& labels,
                     const VolumeFacts& facts, std::span<const LabelInfo> infos,
                     const node::LabelSurvey& survey) {
  std::vector<LabelShare> shares = sharesOf(survey);
  if (shares.empty()) fail(ExitCode::kVolume, "{}: no voxel has a label", labels.file);
  constexpr auto kMost = static_cast<std::size_t>(kMostLabelLayers);
  if (shares.size() > kMost) shares.resize(kMost);
  Scene scene;
  scene.volume = volume;
  scene.labels = labels;
  for (const LabelShare& share : shares) scene.layers.push_back(layerOf(share, infos, facts.grid));
  scene.camera = viewOfLabels(scene, facts, survey);
  return scene;
}

}  // namespace burin::host
