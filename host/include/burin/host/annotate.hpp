#pragma once

#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/picture.hpp"
#include "burin/host/text.hpp"

namespace burin::host {

/// Draws the scene's annotations into the picture of `frame`, each where the frame has least in its
/// way among a few places at the border (the title's at the top first), and none over another. One
/// that is larger than the picture is left out. `scene`: resolved. Returns the rectangles outside
/// of which no pixel has changed. Throws Error{kUsage} if there is no font.
std::vector<PixelRectangle> annotate(DisplayPicture& picture, ImageView<const Rgba> frame,
                                     const Scene& scene, const VolumeFacts& volume,
                                     const Camera& camera);

/// Pixels that a world length in the image plane's direction takes at the depth of the camera's
/// target (the volume's centre if it has none).
double pixelsPerWorldUnit(const Scene& scene, const VolumeFacts& volume, const Camera& camera);

/// Where a world direction points on the screen, x right and y *down*; unit length if it lies in
/// the image plane.
glm::dvec2 directionOnScreen(const glm::dvec3& world, const Camera& camera);

/// The largest of 1, 2 and 5 times a power of ten that is no larger than `limit` (> 0).
double roundLength(double limit);

}  // namespace burin::host
