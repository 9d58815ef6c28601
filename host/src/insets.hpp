#pragma once

#include "burin/common/camera.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/picture.hpp"

namespace burin::host {

/// Small pictures to be laid over a picture: 4 channels, straight alpha. `fontSize` in pixels.

DisplayPicture titleInset(const std::string& title, int fontSize, const Colour& ink);

/// A bar of `pixels` (rounded) with its label below.
DisplayPicture scaleBarInset(double pixels, const std::string& label, int fontSize,
                             const Colour& ink);

/// The world's axes as arrows: x red, y green, z blue, those that point away first. Named X, Y, Z,
/// or for anatomical volumes L, P, S: left, posterior, superior.
DisplayPicture orientationInset(const Camera& camera, bool isAnatomical, int fontSize,
                                const Colour& ink);

/// Each layer's opacity over its values, filled with the colour there. `layers`: resolved.
DisplayPicture legendInset(const std::vector<Layer>& layers, int fontSize, const Colour& ink);

}  // namespace burin::host
