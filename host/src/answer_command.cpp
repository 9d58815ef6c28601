#include <cstdio>

#include "burin/host/commands.hpp"

namespace burin::host {

int runCommand(const Communicator& comm, const Answer& answer) {
  if (comm.isRoot()) std::fputs(answer.text.c_str(), stdout);
  return 0;
}

}  // namespace burin::host
