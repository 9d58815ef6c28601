#include "burin/common/log.hpp"

#include <atomic>
#include <cstdio>
#include <string>

namespace burin {

namespace {
std::atomic<bool> quietNotes{false};
}

void setQuiet(bool quiet) {
  quietNotes.store(quiet);
}

void writeLog(std::string_view prefix, std::string_view line, bool suppressedWhenQuiet) {
  if (suppressedWhenQuiet && quietNotes.load()) return;
  // One write per line: the launcher mixes the ranks' output, and must not cut a line in two.
  const std::string whole = fmt::format("burin: {}{}\n", prefix, line);
  std::fwrite(whole.data(), 1, whole.size(), stderr);
  std::fflush(stderr);
}

}  // namespace burin
