// The module with OpenImageIO in it; see picture_file.hpp.
#include <OpenImageIO/imageio.h>

#include <memory>
#include <utility>

#include "picture_file.hpp"

namespace burin::node {
namespace {

using Desc = OIIO::TypeDesc;

constexpr std::pair<Desc::BASETYPE, const char*> kTypes[] = {
    {Desc::UINT8, "u8"},  {Desc::INT8, "i8"},    {Desc::UINT16, "u16"},
    {Desc::INT16, "i16"}, {Desc::UINT32, "u32"}, {Desc::INT32, "i32"},
    {Desc::FLOAT, "f32"}, {Desc::DOUBLE, "f64"}, {Desc::HALF, "f32"}};

class OiioFile : public PictureFile {
 public:
  explicit OiioFile(std::unique_ptr<OIIO::ImageInput> input) : input_{std::move(input)} {}

  std::string format() const override { return input_->format_name(); }

  int pages() override {
    int count = 1;
    while (input_->seek_subimage(count, 0)) ++count;
    return count;
  }

  PageShape shape(int page) override {
    const OIIO::ImageSpec spec = input_->spec_dimensions(page);
    return {spec.width, spec.height, spec.nchannels, typeName(spec.format)};
  }

  std::string text(const std::string& attribute) override {
    return std::string{input_->spec(0).get_string_attribute(attribute)};
  }

  double number(const std::string& attribute) override {
    return input_->spec(0).get_float_attribute(attribute, 0);
  }

  std::string read(int page, std::span<std::byte> out) override {
    const OIIO::ImageSpec spec = input_->spec_dimensions(page);
    const Desc type = spec.format == Desc::HALF ? Desc{Desc::FLOAT} : spec.format;
    if (input_->read_image(page, 0, 0, spec.nchannels, type, out.data())) return "";
    const std::string reason = input_->geterror();
    return reason.empty() ? "unknown reason" : reason;
  }

 private:
  static std::string typeName(const Desc& type) {
    for (const auto& [theirs, ours] : kTypes) {
      if (theirs == type.basetype) return ours;
    }
    return type.c_str();
  }

  std::unique_ptr<OIIO::ImageInput> input_;
};

PictureFile* openPictureFile(const std::string& file, std::string& reason) {
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);  // numbers as they are stored
  auto input = OIIO::ImageInput::open(file, &wanted);
  if (input != nullptr) return new OiioFile{std::move(input)};
  reason = OIIO::geterror();
  return nullptr;
}

}  // namespace
}  // namespace burin::node

extern "C" burin::node::PictureFile* burinOpenPictureFile(const std::string& file,
                                                          std::string& reason) {
  return burin::node::openPictureFile(file, reason);
}
