#include "label_scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/node/survey.hpp"
#include "first_view.hpp"

namespace burin::host {

namespace {

/// Opacity units across the volume's diagonal.
constexpr double kUnitsAcrossVolume = 256;
/// Optical depth of a voxel of what is seen from outside.
constexpr double kFirmDepth = 1;
/// Optical depth of a cube of a label's volume, of what lies around others.
constexpr double kClearDepth = 0.7;

struct LabelShare {
  int label;
  double voxels;
};

/// The boxes of blocks in which labels occur. Labels that are equal modulo 64 are taken for one.
class LabelBoxes {
 public:
  LabelBoxes(const node::LabelSurvey& survey, const glm::ivec3& blocks) {
    boxes_.fill(IndexBox{blocks, glm::ivec3{0}});
    std::size_t i = 0;
    for (int z = 0; z < blocks.z; ++z)
      for (int y = 0; y < blocks.y; ++y)
        for (int x = 0; x < blocks.x; ++x) add({x, y, z}, survey.blocks[i++]);
  }

  /// Whether some other label's box lies in this one's and is clearly smaller, as a skull's in a
  /// head's: what encloses is seldom closed, and thinner than a block, so neighbours tell less.
  bool isAround(int label) const {
    constexpr double kSmaller = 0.8;
    const IndexBox& around = boxes_[bit(label)];
    for (std::size_t other = 1; other < kLabels; ++other) {
      const IndexBox& box = boxes_[other];
      if (!box.empty() && around.contains(box) && volumeOf(box) < kSmaller * volumeOf(around))
        return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kLabels = 64;
  static std::size_t bit(int label) { return static_cast<unsigned>(label) & (kLabels - 1); }

  static double volumeOf(const IndexBox& box) {
    const glm::dvec3 size{box.size()};
    return size.x * size.y * size.z;
  }

  void add(const glm::ivec3& block, node::LabelSet set) {
    for (; set != 0; set &= set - 1) {
      IndexBox& box = boxes_[static_cast<std::size_t>(std::countr_zero(set))];
      box.lo = glm::min(box.lo, block);
      box.hi = glm::max(box.hi, block + 1);
    }
  }

  std::array<IndexBox, kLabels> boxes_;
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

/// A layer of one colour and of an extinction per world unit, whatever the values, with what shows
/// its shape.
Layer plainLayer(std::string name, const Colour& colour, double extinction,
                 const VolumeGrid& grid) {
  const double unit = 2 * grid.boundingRadius() / kUnitsAcrossVolume;
  Layer layer;
  layer.name = std::move(name);
  layer.transferFunction = {{{0, colour, -std::expm1(-extinction * unit)}}, unit};
  for (const char* style : {"light", "edges"})
    layer.styles.push_back(defaultSettings(*findStyle(style)));
  return layer;
}

Layer layerOf(const LabelShare& share, bool isAround, std::span<const LabelInfo> infos,
              const VolumeGrid& grid) {
  const auto info = std::ranges::find(infos, share.label, &LabelInfo::value);
  const bool isKnown = info != infos.end();
  const std::string name =
      isKnown && !info->name.empty() ? info->name : fmt::format("label {}", share.label);
  const Colour colour = isKnown && info->colour ? *info->colour : paletteColour(share.label);
  const double side = std::cbrt(share.voxels * grid.spacing.x * grid.spacing.y * grid.spacing.z);
  const double extinction = isAround ? kClearDepth / side : kFirmDepth / grid.smallestSpacing();
  Layer layer = plainLayer(name, colour, extinction, grid);
  layer.labels = {share.label};
  return layer;
}

/// What no layer of their own is left for.
Layer layerOfOthers(std::span<const LabelShare> shares, const VolumeGrid& grid) {
  Layer layer =
      plainLayer("other labels", parseColour("#c8c4bc"), kFirmDepth / grid.smallestSpacing(), grid);
  for (const LabelShare& share : shares) layer.labels.emplace_back(share.label);
  return layer;
}

glm::ivec3 blocksOf(const VolumeGrid& grid) {
  const int blockCells = node::blockCellsFor(grid.dims);
  return (grid.cells() + blockCells - 1) / blockCells;
}

/// firstView() of all that has a label. Segmentations are of scans, whose slices lie along z, so
/// that is up also where the file does not say it.
CameraChoice viewOfLabels(const Scene& scene, const VolumeFacts& facts,
                          const node::LabelSurvey& survey) {
  node::BlockRanges blocks;
  blocks.blockCells = node::blockCellsFor(facts.grid.dims);
  blocks.blocks = blocksOf(facts.grid);
  for (const node::LabelSet set : survey.blocks) {
    blocks.lowest.push_back(0);
    blocks.highest.push_back((set & ~node::labelSet(0)) != 0 ? 1.0f : 0.0f);
  }
  Scene shown = scene;
  shown.layers.resize(1);
  shown.layers[0].transferFunction.points = {{0.4, {}, 0}, {0.6, {}, 1}};
  VolumeFacts scan = facts;
  scan.anatomical = true;
  return firstView(shown, scan, blocks);
}

}  // namespace

Scene makeLabelScene(const VolumeChoice& volume, const LabelVolumeChoice& labels,
                     const VolumeFacts& facts, std::span<const LabelInfo> infos,
                     const node::LabelSurvey& survey) {
  std::vector<LabelShare> shares = sharesOf(survey);
  if (shares.empty()) fail(ExitCode::kVolume, "{}: no voxel has a label", labels.file);
  constexpr auto kMost = static_cast<std::size_t>(kMostLabelLayers);
  const std::size_t own = shares.size() > kMost ? kMost - 1 : shares.size();
  const LabelBoxes boxes{survey, blocksOf(facts.grid)};
  Scene scene;
  scene.volume = volume;
  scene.labels = labels;
  for (const LabelShare& share : std::span{shares}.first(own))
    scene.layers.push_back(layerOf(share, boxes.isAround(share.label), infos, facts.grid));
  if (own < shares.size())
    scene.layers.push_back(layerOfOthers(std::span{shares}.subspan(own), facts.grid));
  scene.camera = viewOfLabels(scene, facts, survey);
  return scene;
}

}  // namespace burin::host
