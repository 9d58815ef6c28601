#include "help_texts.hpp"

#include <fmt/format.h>

#include "burin/node/procedural.hpp"
#include "burin/node/volume_writer.hpp"

namespace burin::host {

std::string programFooter() {
  return R"(Examples:
  burin render head.nrrd -o head.png                draw a volume with a scene of burin's own
  mpirun --bind-to none -n 4 burin render scene.json   the same picture, from four ranks
  burin info head.nrrd                              what the file holds
  burin COMMAND --help                              the options of one command

Exit codes: 0 done, 2 bad usage or scene, 3 bad volume, 4 a rank failed.)";
}

std::string renderFooter() {
  return R"(A file named .json is a scene, any other a volume, which is drawn with a scene made from its
histogram; --save-scene writes that scene down, to be edited.

--set takes the path of a key in the scene file and a JSON value, or a bare word:
  --set layers.0.style.tone.strength=0.5   --set quality.step_voxels=0.25
  --set camera.view=anterior               --set image.background=transparent
`burin styles` lists every style with its parameters; configs/schema.json has every key.

PNG is display-referred over the background; EXR is the float frame, premultiplied linear RGBA
without background. Both carry the scene, the program's version and the step.

On many ranks start with `mpirun --bind-to none`: Open MPI otherwise binds each to one core.)";
}

std::string makeVolumeFooter() {
  std::string text = "KIND is one of\n";
  for (const auto& kind : node::proceduralKinds())
    text += fmt::format("  {:<16} {}\n", kind.name, kind.help);
  return text +
         fmt::format("The format goes by the file's extension: {}\n", node::writableExtensions());
}

}  // namespace burin::host
