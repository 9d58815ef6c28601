#include "options/volume_input.hpp"

#include "burin/common/error.hpp"

namespace burin::host {

namespace {

constexpr int kMostComponents = 1 << 20;

}  // namespace

void addRawOptions(OptionList& list, RawText& text) {
  list.text("--dims", text.dims, "X,Y,Z", "Voxels along each axis of a bare raw file");
  list.choice("--type", text.type,
              {"u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64", "f32", "f64"},
              "Type of its voxels", "TYPE");
  list.choice("--endian", text.endian, {"little", "big"}, "Byte order of its voxels", "ORDER");
  list.text("--spacing", text.spacing, "X,Y,Z", "Distance of its voxels in world units");
  list.integer("--component", text.component, 0, kMostComponents,
               "Component of voxels that have several; 0 is the first");
  list.text("--series", text.series, "UID|N", "Series of a DICOM folder that holds several");
}

RawLayout rawLayout(const RawText& text) {
  RawLayout raw;
  if (!text.dims.empty()) raw.dims = parseDims(text.dims, "--dims");
  if (!text.type.empty()) raw.type = text.type;
  if (!text.endian.empty()) raw.endian = text.endian;
  if (!text.spacing.empty()) raw.spacing = parseSpacing(text.spacing, "--spacing");
  if (text.component >= 0) raw.component = text.component;
  if (!text.series.empty()) raw.series = text.series;
  return raw;
}

void RawLayout::applyTo(VolumeChoice& choice) const {
  if (dims) choice.dims = dims;
  if (type) choice.type = type;
  if (endian) choice.endian = endian;
  if (spacing) choice.spacing = spacing;
  if (component) choice.component = component;
  if (series) choice.series = series;
}

void addLabelNames(OptionList& list, std::string& names) {
  list.text("--label-names", names, "FILE", "Names and colours of labels as ITK-SNAP writes them");
}

void addLabelOptions(OptionList& list, LabelText& text) {
  list.text("--labels", text.file, "FILE",
            "A segmentation on the volume's grid; without a scene each label is a layer");
  addLabelNames(list, text.names);
  list.integer("--label-component", text.component, 0, kMostComponents,
               "Component of labels that have several; 0 is the first");
}

LabelOptions labelOptions(const LabelText& text) {
  LabelOptions options{text.file, text.names, {}};
  if (text.component >= 0) options.component = text.component;
  return options;
}

void LabelOptions::applyTo(LabelVolumeChoice& choice) const {
  if (!file.empty()) {
    choice = {};
    choice.file = file;
  }
  if (!names.empty()) choice.names = names;
  if (component) choice.component = component;
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
