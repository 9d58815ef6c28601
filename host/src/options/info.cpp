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
  addRawOptions(list, info->raw);
  return [info](int) {
    if (!info->options.isBuild && info->options.volume.empty())
      fail(ExitCode::kUsage, "info: expected a VOLUME, or --build");
    info->options.raw = rawLayout(info->raw);
    return info->options;
  };
}

}  // namespace burin::host
