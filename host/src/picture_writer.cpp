#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <span>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/picture.hpp"

namespace burin::host {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void failWriting(const fs::path& target, const std::string& reason) {
  fail(ExitCode::kRank, "{}: cannot be written: {}", target.string(), reason);
}

void describe(OIIO::ImageSpec& spec, const PictureMetadata& metadata) {
  spec.attribute("Software", fmt::format("burin {}", programVersion()));
  spec.attribute("burin:version", programVersion());
  spec.attribute("burin:scene", metadata.scene);
  // As text: PNG has no other kind of entry.
  if (metadata.stepVoxels)
    spec.attribute("burin:step_voxels", fmt::format("{}", *metadata.stepVoxels));
  spec.attribute("burin:orbit_deg", fmt::format("{}", metadata.orbitDeg));
}

/// The whole file in memory: the library's own writing of PNG does not notice a full disk.
std::vector<unsigned char> encode(const fs::path& target, const std::string& format,
                                  const OIIO::ImageSpec& spec, const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput sink{bytes};
  const auto out = OIIO::ImageOutput::create(format);
  if (!out) failWriting(target, OIIO::geterror());
  const bool isWhole = out->set_ioproxy(&sink) && out->open(target.string(), spec) &&
                       out->write_image(spec.format, pixels) && out->close();
  if (!isWhole) failWriting(target, out->geterror());
  return bytes;
}

void writePicture(const fs::path& target, const std::string& format, const OIIO::ImageSpec& spec,
                  const void* pixels) {
  const auto bytes = encode(target, format, spec, pixels);
  writeFile(target, std::as_bytes(std::span{bytes}));
}

}  // namespace

void writePng(const fs::path& target, const DisplayPicture& picture,
              const PictureMetadata& metadata) {
  OIIO::ImageSpec spec{picture.size.width, picture.size.height, picture.channels,
                       OIIO::TypeDesc::UINT8};
  describe(spec, metadata);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  writePicture(target, "png", spec, picture.bytes.data());
}

void writeExr(const fs::path& target, ImageView<const Rgba> frame,
              const PictureMetadata& metadata) {
  static_assert(sizeof(Rgba) == 4 * sizeof(float));
  OIIO::ImageSpec spec{frame.size().width, frame.size().height, 4, OIIO::TypeDesc::FLOAT};
  describe(spec, metadata);
  spec.attribute("DateTime", "");  // keeps the library from adding the time of day
  writePicture(target, "openexr", spec, frame.pixels().data());
}

}  // namespace burin::host
