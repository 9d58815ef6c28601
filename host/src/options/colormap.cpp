#include <memory>

#include "burin/common/error.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

constexpr const char* kColormapFooter =
    R"(Reads ParaView's JSON and 3D Slicer's .vp and .vp.json and writes a scene with that transfer
function, to be drawn with --volume; or, with --paraview, writes the transfer function of a scene's
layer as ParaView's JSON. Colours are blended as the other program blends them, and stay within
1.25/255 of that. A scene can also name the file itself:
  "transfer_function": { "file": "cool.json", "range": [300, 700] })";

}  // namespace

Finish describeColormap(OptionList& list) {
  const auto options = std::make_shared<ColormapOptions>();
  list.text("INPUT", options->input, "FILE", "A colour map, or a scene").required();
  list.path("-o,--output", options->output, "FILE.json", "The file to write").required();
  const Option paraview = list.flag("--paraview", options->toParaview,
                                    "Write a scene's transfer function for ParaView");
  list.text("--map", options->map, "NAME", "Which of several maps in the file (the first)")
      .excludes(paraview);
  list.integer("--layer", options->layer, 0, kMostListed - 1, "Which layer of the scene (0)")
      .needs("--paraview");
  list.footer(kColormapFooter);
  return [options](int) { return *options; };
}

}  // namespace burin::host
