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

std::string benchCompositingFooter() {
  return R"(Composites the same subimages with burin and, where it is found, with IceT, in turns: a scene's
footprints (built-in scenes unless INPUT is given), full frames, and discs of growing size. Writes
compositing.csv and plots (gnuplot) to the folder, and prints the ratios to IceT's best.

Start it with as many ranks as are to be measured: mpirun --bind-to none -n 8 burin bench compositing
`scripts/get-icet` fetches IceT; another one is found by BURIN_ICET_FOLDER=FOLDER.)";
}

}  // namespace burin::host
