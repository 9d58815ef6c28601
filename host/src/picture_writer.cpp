#include <span>

#include "burin/common/error.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/picture.hpp"
#include "picture_encoder.hpp"
#include "picture_module.hpp"

namespace burin::host {

namespace {

namespace fs = std::filesystem;

EncodePicture& encoder() {
  static auto* const function = reinterpret_cast<EncodePicture*>(pictureFunction(kEncodePicture));
  return *function;
}

void describe(PictureToEncode& picture, const PictureMetadata& metadata) {
  const auto add = [&](const char* key, std::string value) {
    picture.attributes.emplace_back(key, std::move(value));
  };
  add("Software", fmt::format("burin {}", programVersion()));
  add("burin:version", programVersion());
  add("burin:scene", metadata.scene);
  // As text: PNG has no other kind of entry.
  if (metadata.stepVoxels) add("burin:step_voxels", fmt::format("{}", *metadata.stepVoxels));
  add("burin:orbit_deg", fmt::format("{}", metadata.orbitDeg));
  add("burin:technique", metadata.technique);
  add("burin:precision", metadata.precision);
  add("burin:combine", metadata.combine);
}

void writePicture(const fs::path& target, const PictureToEncode& picture) {
  EncodedPicture encoded;
  encoder()(picture, encoded);
  if (!encoded.error.empty())
    fail(ExitCode::kRank, "{}: cannot be written: {}", target.string(), encoded.error);
  writeFile(target, std::as_bytes(std::span{encoded.bytes}));
}

}  // namespace

void loadPictureEncoder() {
  encoder();
}

std::string pictureLibraryVersion() {
  return reinterpret_cast<PictureLibrary*>(pictureFunction(kPictureLibrary))();
}

void writePng(const fs::path& target, const DisplayPicture& picture,
              const PictureMetadata& metadata) {
  PictureToEncode file{.format = "png",
                       .name = target.string(),
                       .width = picture.size.width,
                       .height = picture.size.height,
                       .channels = picture.channels,
                       .isFloat = false,
                       .pixels = picture.bytes.data(),
                       .attributes = {}};
  describe(file, metadata);
  file.attributes.emplace_back("oiio:ColorSpace", "sRGB");
  file.attributes.emplace_back("oiio:UnassociatedAlpha", 1);
  writePicture(target, file);
}

void writeExr(const fs::path& target, ImageView<const Rgba> frame,
              const PictureMetadata& metadata) {
  static_assert(sizeof(Rgba) == 4 * sizeof(float));
  PictureToEncode file{.format = "openexr",
                       .name = target.string(),
                       .width = frame.size().width,
                       .height = frame.size().height,
                       .channels = 4,
                       .isFloat = true,
                       .pixels = frame.pixels().data(),
                       .attributes = {}};
  describe(file, metadata);
  file.attributes.emplace_back("DateTime", "");  // keeps the library from adding the time of day
  writePicture(target, file);
}

}  // namespace burin::host
