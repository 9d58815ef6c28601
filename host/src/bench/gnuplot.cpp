#include "bench/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

#include "burin/common/error.hpp"

namespace burin::host::bench {

bool runGnuplot(const std::filesystem::path& folder, const std::filesystem::path& script) {
  std::string program = "gnuplot";
  std::string file = script.string();
  const std::array<char*, 3> arguments{program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int refused =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (refused == ENOENT) return false;
  if (refused != 0) fail(ExitCode::kRank, "gnuplot cannot be started: {}", systemText(refused));
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(ExitCode::kRank, "gnuplot is lost: {}", systemText(errno));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail(ExitCode::kRank, "gnuplot failed on {}", (folder / script).string());
  return true;
}

}  // namespace burin::host::bench
