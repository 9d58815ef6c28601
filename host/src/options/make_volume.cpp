#include <fmt/format.h>

#include <memory>

#include "burin/node/procedural.hpp"
#include "burin/node/volume_writer.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

std::string makeVolumeFooter() {
  std::string text = "KIND is one of\n";
  for (const auto& kind : node::proceduralKinds())
    text += fmt::format("  {:<18} {}\n", kind.name, kind.help);
  return text +
         fmt::format("The format goes by the file's extension: {}\n", node::writableExtensions());
}

struct MakeVolume {
  MakeVolumeOptions options;
  std::string dims, spacing;
};

}  // namespace

Finish describeMakeVolume(OptionList& list) {
  const auto make = std::make_shared<MakeVolume>();
  MakeVolumeOptions& options = make->options;
  list.text("KIND", options.kind, "TEXT", "What to make, see below").required();
  list.text("--dims", make->dims, "X,Y,Z", "Voxels along each axis").required();
  list.choice("--type", options.type, {"u8", "i16", "u16", "f32"}, "Type of the voxels (u8)",
              "TYPE");
  list.text("--spacing", make->spacing, "X,Y,Z", "Distance of voxels in world units (1,1,1)");
  list.path("-o,--output", options.output, "FILE", "The file to write").required();
  list.footer(makeVolumeFooter());
  return [make](int) {
    make->options.dims = parseDims(make->dims, "--dims");
    if (!make->spacing.empty()) make->options.spacing = parseSpacing(make->spacing, "--spacing");
    return make->options;
  };
}

}  // namespace burin::host
