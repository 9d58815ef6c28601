#pragma once

#include "burin/common/scene.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// A view of a volume that nobody has looked at yet: from the front, a little to the side (farther
/// where it is deep) and from above (farther for flat boxes); magnified until what can show fills
/// the picture in this view. Unless the file is anatomical, the front is the side where more of the
/// surfaces of solid bodies are: faces have more of them than backs of heads. World z is up for
/// volumes whose spacings differ, whose box is flat in z, that are mirror-symmetric left to right
/// in x and in no other axis, as scans of heads and bodies are, or in which what shows covers one
/// end of z like a floor or a ceiling; y for the rest. What the volume's upper face cuts off, such
/// as a neck, and wider than its other end is upside down, as is what has a sheet (a table) above
/// it, unless the file is anatomical and says what is up. `scene`: its layers, picture and field of
/// view; `blocks`: of the volume.
CameraChoice firstView(const Scene& scene, const VolumeFacts& facts,
                       const node::BlockRanges& blocks);

}  // namespace burin::host
