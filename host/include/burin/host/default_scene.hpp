#pragma once

#include "burin/common/scene.hpp"
#include "burin/host/material_profile.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// A scene for a volume that comes without one. What is darker than the background's boundary is
/// left out; what is brighter, if that is what is at the volume's faces. If a denser material lies
/// within or beside another one, that one is a translucent skin, as firm as it may be without
/// hiding much of the denser one from the first view; else opacity rises over all that is there. Of
/// a field without a background only boundaries show. The opacity unit length follows the volume's
/// size, so that a coarse and a fine scan of one thing look alike. `scene.volume` is `choice`;
/// `profile` and `blocks` are of that volume.
Scene makeDefaultScene(const VolumeChoice& choice, const VolumeFacts& facts,
                       const MaterialProfile& profile, const node::BlockRanges& blocks);

}  // namespace burin::host
