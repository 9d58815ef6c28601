#include <cstdio>

#include "burin/common/style.hpp"
#include "burin/host/commands.hpp"

namespace burin::host {

int runCommand(const Communicator& comm, const StylesOptions&) {
  if (comm.isRoot()) std::fputs(styleHelp().c_str(), stdout);
  return 0;
}

}  // namespace burin::host
