#pragma once

#include <concepts>
#include <csignal>
#include <functional>
#include <utility>

namespace burin::host {

/// While one of these lives, SIGINT and SIGTERM only set a flag, once each (the second one ends the
/// process), so that half-written files get removed. Outside of it they end the process at once.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  struct sigaction previousInt_ {};
  struct sigaction previousTerm_ {};
};

/// The signal that came, or 0. A rank's own: what all ranks do about it is agreed at frame ends.
int interruptSignal();

/// Exit code of a command that a signal ended, less the signal's number, as shells have it.
inline constexpr int kSignalExitBase = 128;

/// Local. Runs `work`, which holds a temporary file for a moment; a signal that comes meanwhile
/// ends the process afterwards.
template <std::invocable Work>
void deferInterrupts(Work&& work) {
  {
    const InterruptWatch watch;
    std::invoke(std::forward<Work>(work));
  }
  if (const int signal = interruptSignal(); signal != 0) std::raise(signal);
}

}  // namespace burin::host
