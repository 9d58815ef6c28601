#pragma once

#include <string>
#include <vector>

namespace burin::test {

/// What a run of the program `burin` came to.
struct ProgramResult {
  int exitCode = -1;
  std::string out;
  std::string err;
};

/// Runs `burin ARGUMENTS` as a process of its own; with `ranks` > 0 under the MPI launcher.
/// `prefix` goes before the command (a shell word or more, e.g. a `timeout`).
ProgramResult runBurin(const std::vector<std::string>& arguments, int ranks = 0,
                       const std::string& prefix = "");

/// The one line of an error message without its newline; fails the test if `err` is not exactly one
/// line that begins with "burin: ".
std::string onlyLine(const std::string& err);

}  // namespace burin::test
