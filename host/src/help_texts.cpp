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

--technique slices draws the same samples as Lum and Ma's hardware did, a plane, layer and pass at a
time. In float it is the same picture; --precision half and byte, and quality.combine "over" (each
draw over the one before), show what such hardware cost. Rays cannot end early: quality.termination
has no effect.

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

std::string benchAccuracyFooter() {
  return R"(Draws the built-in scenes (or INPUT) at fixed steps and for max_error settings, with and without
pre-integration, and as slices in float, half and byte framebuffers, in turns, and compares with the
double-precision reference, whose own change on halving its step is shown. Writes accuracy.csv and
accuracy.png (gnuplot: error against time and samples, the Pareto front marked) to the folder.)";
}

std::string benchMaxErrorFooter() {
  return R"(Asks for errors of 1/32, 1/128 and 1/512 in three views of each volume, with a smooth and a spiky
transfer function, and compares every pixel with the double-precision reference, halved until it has
converged. Then draws at fixed steps of 4, 2, 1 … voxels until one is as good, and compares the
samples, those that were needed to choose the steps included. Writes max_error.csv to the folder.

burin bench max-error *.nrrd      takes minutes per volume)";
}

std::string benchSkipFooter() {
  return R"(Draws one ball, 30 balls and vessels with empty-space skipping on and off, in turns with a volume
in which everything is visible; or only INPUT, if it is given. Samples are counted in frames that
are not timed. Writes skip.csv and a plot (gnuplot) to the folder, and prints how the targets fare.

One rank is what it is meant for; on more the time is the slowest rank's.)";
}

std::string benchScalingFooter() {
  return R"(Mode "isolated": rank 0 cuts the volume as for 1, 2, 4 … ranks and draws each rank's brick by itself
with all threads; a frame is the slowest of them and what the cost model says of merging what they
drew over a fast network. Mode "wall": whole frames on 1, 2, 4 … of the ranks that burin was started
with, up to the cores there are.

Strong scaling of one scene (INPUT if it is given); without INPUT also weak scaling, the volume growing
with the ranks, and Lum and Ma's case: a volume of twice --size on 8 ranks and a host, with tone and
edges in one layer and in two. Writes scaling.csv and a plot (gnuplot) to the folder.

mpirun --bind-to none -n 2 burin bench scaling      with wall times on 1 and 2 ranks)";
}

}  // namespace burin::host
