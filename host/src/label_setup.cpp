#include "label_setup.hpp"

#include <algorithm>

#include "burin/common/error.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/label_volume.hpp"

namespace burin::host {

namespace {

std::unique_ptr<node::BrickSource> openLabelVolume(const LabelVolumeChoice& choice,
                                                   const node::VolumeInfo& volume) {
  VolumeChoice first = choice;
  first.component = choice.component.value_or(0);
  auto labels = node::openVolume(first);
  const node::VolumeInfo& info = labels->info();
  if (info.components > 1 && !choice.component)
    fail(ExitCode::kVolume,
         "{}: {} layers of labels that may overlap (expected one: choose with --label-component "
         "0 ... {}, or \"component\" in the scene's \"labels\")",
         info.name, info.components, info.components - 1);
  node::checkLabelVolume(volume, info);
  return labels;
}

/// Those of the component that is read.
std::vector<LabelInfo> ofComponent(std::vector<LabelInfo> labels, int component) {
  std::erase_if(labels, [&](const LabelInfo& label) { return label.component != component; });
  return labels;
}

}  // namespace

void openLabels(const Communicator& comm, const LabelVolumeChoice& choice,
                PreparedScene& prepared) {
  together(comm, "opening the labels",
           [&] { prepared.labels = openLabelVolume(choice, prepared.source->info()); });
  const node::VolumeInfo& info = prepared.labels->info();
  prepared.labelInfos =
      info.components > 1 ? ofComponent(info.labels, *choice.component) : info.labels;
  if (choice.names.empty()) return;
  const std::vector<LabelInfo> described = labelDescriptions(comm, choice.names);
  std::erase_if(prepared.labelInfos, [&](const LabelInfo& label) {
    return std::ranges::find(described, label.value, &LabelInfo::value) != described.end();
  });
  prepared.labelInfos.insert(prepared.labelInfos.end(), described.begin(), described.end());
}

std::vector<LabelInfo> labelDescriptions(const Communicator& comm, const std::string& file) {
  std::string text;
  onRoot(comm, [&] { text = readLabelDescriptions(file); });
  text = broadcastText(comm, std::move(text), Rank{0});
  std::vector<LabelInfo> labels;
  together(comm, "the label descriptions", [&] { labels = parseLabelDescriptions(text, file); });
  return labels;
}

void resolveLabels(const Communicator& comm, PreparedScene& prepared) {
  together(comm, "the scene", [&] {
    if (prepared.labels)
      return burin::resolveLabels(prepared.scene, prepared.labelInfos,
                                  prepared.labels->info().name);
    const auto& layers = prepared.scene.layers;
    const auto bound =
        std::ranges::find_if(layers, [](const Layer& l) { return !l.labels.empty(); });
    if (bound != layers.end())
      fail(
          ExitCode::kUsage,
          "layers[{}].labels: there is no label volume (\"labels\" of the scene, or --labels FILE)",
          bound - layers.begin());
  });
}

}  // namespace burin::host
