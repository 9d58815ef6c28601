#include "label_masks.hpp"

#include <algorithm>
#include <map>

namespace burin::node {

namespace {

/// Ascending labels of a layer.
std::vector<int> labelsOf(const Layer& layer) {
  std::vector<int> set;
  for (const LabelName& label : layer.labels) set.push_back(std::get<int>(label));
  std::ranges::sort(set);
  set.erase(std::ranges::unique(set).begin(), set.end());
  return set;
}

}  // namespace

LabelMasks::LabelMasks(const Scene& scene) {
  std::map<int, MaskBits> ofLabel;
  for (const Layer& layer : scene.layers) {
    if (layer.labels.empty() || of(layer) >= 0) continue;
    sets_.push_back(labelsOf(layer));
    for (const int label : sets_.back())
      ofLabel[label] = static_cast<MaskBits>(ofLabel[label] | 1u << (sets_.size() - 1));
  }
  ofLabel_.assign(ofLabel.begin(), ofLabel.end());
}

int LabelMasks::of(const Layer& layer) const {
  const auto found = std::ranges::find(sets_, labelsOf(layer));
  return found == sets_.end() ? -1 : static_cast<int>(found - sets_.begin());
}

void LabelMasks::bitsOf(std::span<const int> labels, std::vector<MaskBits>& bits) const {
  bits.resize(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i > 0 && labels[i] == labels[i - 1]) {  // mostly
      bits[i] = bits[i - 1];
      continue;
    }
    const auto found =
        std::ranges::lower_bound(ofLabel_, labels[i], {}, &std::pair<int, MaskBits>::first);
    bits[i] = found != ofLabel_.end() && found->first == labels[i] ? found->second : MaskBits{0};
  }
}

}  // namespace burin::node
