#include <memory>

#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

Finish describeInfo(OptionList& list) {
  struct Info {
    InfoOptions options;
    RawText raw;
  };
  const auto info = std::make_shared<Info>();
  list.text("VOLUME", info->options.volume, "FILE", "The volume").required();
  addRawOptions(list, info->raw);
  return [info](int) {
    info->options.raw = rawLayout(info->raw);
    return info->options;
  };
}

}  // namespace burin::host
