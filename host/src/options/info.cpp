#include <memory>

#include "burin/common/error.hpp"
#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

Finish describeInfo(OptionList& list) {
  struct Info {
    InfoOptions options;
    RawText raw;
  };
  const auto info = std::make_shared<Info>();
  const Option volume = list.text("VOLUME", info->options.volume, "FILE", "The volume");
  list.flag("--build", info->options.isBuild,
            "Describe the program instead: versions, OpenGL, threads, limits")
      .excludes(volume);
  list.path(
          "--histogram2d", info->options.gradientHistogram, "FILE",
          "Draw values against gradient magnitudes (PNG), to lay a transfer function's widgets on")
      .needs("VOLUME");
  addRawOptions(list, info->raw);
  addLabelNames(list, info->options.labelNames);
  return [info](int) {
    if (!info->options.isBuild && info->options.volume.empty())
      fail(ExitCode::kUsage, "info: expected a VOLUME, or --build");
    info->options.raw = rawLayout(info->raw);
    return info->options;
  };
}

}  // namespace burin::host
