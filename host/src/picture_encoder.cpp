#include "picture_encoder.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace burin::host {

namespace {

OIIO::ImageSpec specOf(const PictureToEncode& picture) {
  OIIO::ImageSpec spec{picture.width, picture.height, picture.channels,
                       picture.isFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8};
  for (const auto& attribute : picture.attributes) {
    const std::string& key = attribute.first;
    std::visit([&](const auto& value) { spec.attribute(key, value); }, attribute.second);
  }
  return spec;
}

}  // namespace

extern "C" void burinEncodePicture(const PictureToEncode& picture, EncodedPicture& encoded) {
  // The whole file in memory: the library's own writing of PNG does not notice a full disk.
  OIIO::Filesystem::IOVecOutput sink{encoded.bytes};
  const auto out = OIIO::ImageOutput::create(picture.format);
  if (!out) {
    encoded.error = OIIO::geterror();
    return;
  }
  const OIIO::ImageSpec spec = specOf(picture);
  const bool isWhole = out->set_ioproxy(&sink) && out->open(picture.name, spec) &&
                       out->write_image(spec.format, picture.pixels) && out->close();
  if (!isWhole) encoded.error = out->geterror();
}

extern "C" const char* burinPictureLibrary() {
  static const std::string version = OIIO::get_string_attribute("version", OIIO_VERSION_STRING);
  return version.c_str();
}

static_assert(std::is_same_v<decltype(burinEncodePicture), EncodePicture>);
static_assert(std::is_same_v<decltype(burinPictureLibrary), PictureLibrary>);

}  // namespace burin::host
