#include "burin/host/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace burin::host {

namespace {
constexpr const char* kWipeLine = "\r\x1b[K";
}

Progress::Progress(bool wanted) : active_{wanted && ::isatty(STDERR_FILENO) == 1} {}

Progress::~Progress() {
  clear();
}

void Progress::show(std::string_view text) {
  if (!active_) return;
  std::fprintf(stderr, "%sburin: %.*s", kWipeLine, static_cast<int>(text.size()), text.data());
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  std::fputs(kWipeLine, stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace burin::host
