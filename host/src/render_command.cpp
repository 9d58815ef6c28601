#include "burin/common/log.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/session.hpp"

namespace burin::host {

int runCommand(const Communicator& comm, const RenderOptions& options) {
  setQuiet(options.quiet);
  Session session{comm, options};
  return session.run();
}

}  // namespace burin::host
