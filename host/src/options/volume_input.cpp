#include "options/volume_input.hpp"

#include "burin/common/error.hpp"

namespace burin::host {

void addRawOptions(OptionList& list, RawText& text) {
  list.text("--dims", text.dims, "X,Y,Z", "Voxels along each axis of a bare raw file");
  list.choice("--type", text.type, {"u8", "i16", "u16", "f32"}, "Type of its voxels", "TYPE");
  list.choice("--endian", text.endian, {"little", "big"}, "Byte order of its voxels", "ORDER");
  list.text("--spacing", text.spacing, "X,Y,Z", "Distance of its voxels in world units");
}

RawLayout rawLayout(const RawText& text) {
  RawLayout raw;
  if (!text.dims.empty()) raw.dims = parseDims(text.dims, "--dims");
  if (!text.type.empty()) raw.type = text.type;
  if (!text.endian.empty()) raw.endian = text.endian;
  if (!text.spacing.empty()) raw.spacing = parseSpacing(text.spacing, "--spacing");
  return raw;
}

void RawLayout::applyTo(VolumeChoice& choice) const {
  if (dims) choice.dims = dims;
  if (type) choice.type = type;
  if (endian) choice.endian = endian;
  if (spacing) choice.spacing = spacing;
}

void addInput(OptionList& list, std::string& input) {
  list.text("INPUT", input, "FILE", "A scene (.json) or a volume");
}

void addVolume(OptionList& list, std::string& volume) {
  list.text("--volume", volume, "FILE", "Draw this volume, whatever the scene names");
}

void checkVolumeChoice(const std::string& input, const std::string& volume) {
  if (!input.empty() && !volume.empty() && !isSceneFile(input))
    fail(ExitCode::kUsage, "--volume goes with a scene (a .json file), not with volume {}", input);
}

}  // namespace burin::host
