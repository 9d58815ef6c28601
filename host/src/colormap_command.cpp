#include "burin/common/colour_map.hpp"
#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/common/scene.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

namespace fs = std::filesystem;

/// A scene of one layer that waits for a volume.
std::string sceneText(const ColourMap& map) {
  Scene scene;
  Layer layer;
  layer.name = map.name;
  layer.transferFunction = transferFunctionFrom(map);
  scene.layers = {layer};
  return writeScene(scene);
}

std::string converted(const ColormapOptions& options) {
  if (options.toParaview) {
    const Scene scene = loadScene(options.input);
    const auto count = static_cast<int>(scene.layers.size());
    if (options.layer >= count)
      fail(ExitCode::kUsage, "--layer {}: {} has {} layer{}, counted from 0", options.layer,
           options.input, count, count == 1 ? "" : "s");
    const Layer& layer = scene.layers[static_cast<std::size_t>(options.layer)];
    const std::string name =
        layer.name.empty() ? fs::path{options.input}.stem().string() : layer.name;
    return paraviewJson(layer.transferFunction, name);
  }
  return sceneText(readColourMap(options.input, options.map));
}

}  // namespace

int runCommand(const Communicator& comm, const ColormapOptions& options) {
  onRoot(comm, [&] {
    std::error_code unknown;
    if (fs::equivalent(options.input, options.output, unknown))
      fail(ExitCode::kUsage, "-o {}: this would overwrite the input", options.output.string());
    const std::string text = converted(options);
    deferInterrupts([&] { writeTextFile(options.output, text); });
  });
  return 0;
}

}  // namespace burin::host
