#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <variant>

#include "burin/common/communicator.hpp"
#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/rank_watch.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {
namespace {

/// Every rank comes here with the same failure; one of them says it.
int failAlike(const Communicator& comm, const Error& error) {
  if (comm.isRoot()) writeLog("", error.what(), false);
  return static_cast<int>(error.code());
}

int runTogether(const Communicator& comm, std::span<const char* const> arguments) {
  try {
    Command command;
    together(comm, "the command line", [&] { command = parseCommandLine(arguments, comm.size()); });
    return std::visit([&](const auto& options) { return runCommand(comm, options); }, command);
  } catch (const SharedError& error) {
    return failAlike(comm, error);
  } catch (const CollectiveError& error) {
    return failAlike(comm, error);
  }
}

/// This rank alone is lost, and the others, if any, may wait for it for ever: the whole job ends.
int endAlone(const Communicator& comm, const std::string& reason) {
  RankWatch::leave();
  writeLog("", fmt::format("rank {}: {}", static_cast<int>(comm.rank()), reason), false);
  if (comm.size() > 1) MPI_Abort(comm.get(), static_cast<int>(ExitCode::kRank));
  return static_cast<int>(ExitCode::kRank);
}

int runProgram(std::span<const char* const> arguments) {
  const Communicator world{MPI_COMM_WORLD};
  // A file that may not grow is then an error of the write, which leaves nothing half-written.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const RankWatch watch{world};
    return runTogether(world, arguments);
  } catch (const std::exception& error) {
    return endAlone(world, error.what());
  } catch (...) {
    return endAlone(world, "unknown exception");
  }
}

/// The exit code, once standard output is known to have taken all that was printed.
int afterOutput(int code) {
  errno = 0;
  const bool whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (whole || code != 0) return code;
  writeLog("", fmt::format("standard output: cannot be written whole: {}", systemText(errno)),
           false);
  return static_cast<int>(ExitCode::kRank);
}

}  // namespace
}  // namespace burin::host

int main(int argc, char** argv) {
  try {
    const burin::MpiRuntime runtime{&argc, &argv};
    const int code =
        burin::host::runProgram(std::span{argv + 1, static_cast<std::size_t>(argc - 1)});
    return burin::host::afterOutput(code);
  } catch (const std::exception& error) {  // MPI itself does not start
    burin::writeLog("", error.what(), false);
    return static_cast<int>(burin::ExitCode::kRank);
  }
}
