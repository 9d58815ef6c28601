#pragma once

#include "burin/common/labels.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/label_volume.hpp"

namespace burin::host {

/// Most layers that are made for labels: each takes two textures of a program, of which llvmpipe
/// has 32.
inline constexpr int kMostLabelLayers = 12;

/// A scene for a volume and its segmentation: a layer for each label that occurs but 0, whatever
/// the values, with its name and colour where the segmentation says them; labels of many voxels
/// first. Of more than kMostLabelLayers the last layer holds all that are left. Labels are opaque
/// but those that others lie in. Throws Error{kVolume} if no label occurs.
Scene makeLabelScene(const VolumeChoice& volume, const LabelVolumeChoice& labels,
                     const VolumeFacts& facts, std::span<const LabelInfo> infos,
                     const node::LabelSurvey& survey);

}  // namespace burin::host
