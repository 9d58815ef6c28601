#pragma once

#include "burin/common/scene.hpp"
#include "burin/host/histogram.hpp"

namespace burin::host {

/// A scene for a volume that comes without one: a single layer whose opacity rises from Otsu's
/// threshold of the histogram to the 99th percentile of what lies above it, drawn with light, tone
/// and edges. The opacity unit length follows the volume's size, so that a coarse and a fine scan
/// of one thing look alike. `scene.volume` is `choice`.
Scene makeDefaultScene(const VolumeChoice& choice, const VolumeFacts& facts,
                       const Histogram& histogram);

}  // namespace burin::host
