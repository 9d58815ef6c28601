#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/common/image.hpp"

namespace burin::host {

/// A picture as a screen shows it: sRGB, rows top to bottom, interleaved.
struct DisplayPicture {
  ImageSize size;
  int channels = 3;  ///< 3, or 4 with *straight* alpha
  std::vector<std::uint8_t> bytes;
};

/// The float frame over an opaque background (3 channels), or, without one, with straight alpha
/// (4 channels). Each channel becomes one of the two codes next to it, by a threshold of the
/// pixel's own place: smooth shades keep their mean and show no bands; exact codes (a flat
/// background) stay.
DisplayPicture toDisplay(ImageView<const Rgba> frame, const std::optional<Colour>& background);

/// What a picture file says about itself beside its pixels.
struct PictureMetadata {
  std::string scene;                 ///< JSON text
  std::optional<double> stepVoxels;  ///< the scene's; unset if every tile chose its own
  double orbitDeg = 0;               ///< azimuth added to the scene's (--orbit)
  std::string technique;             ///< "raycast", "slices", "reference"
  std::string precision;  ///< of what samples add up in: "float", "half", "byte", "double"
  std::string combine;    ///< the scene's: "sum", "over"
};

/// Loads the module that encodes pictures, which writePng and writeExr do themselves: so that a
/// broken installation is found before anything is drawn. Throws Error{kRank}.
void loadPictureEncoder();
/// Of OpenImageIO, as loaded. Throws likewise.
std::string pictureLibraryVersion();

/// Write a whole file under a temporary name, then rename it. PNG: 8 bits. EXR: float,
/// premultiplied linear RGBA. Metadata: "Software", "burin:version", "burin:scene",
/// "burin:step_voxels", "burin:orbit_deg", "burin:technique", "burin:precision", "burin:combine".
/// No time of day: the same picture gives the same bytes. Throw Error{kUsage} if the folder cannot
/// be written to, Error{kRank} if writing fails.
void writePng(const std::filesystem::path& target, const DisplayPicture& picture,
              const PictureMetadata& metadata);
void writeExr(const std::filesystem::path& target, ImageView<const Rgba> frame,
              const PictureMetadata& metadata);

}  // namespace burin::host
