#include "options/describe.hpp"

namespace burin::host {

Finish describeStyles(OptionList&) {
  return [](int) { return StylesOptions{}; };
}

}  // namespace burin::host
