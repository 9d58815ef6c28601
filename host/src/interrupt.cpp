#include "burin/host/interrupt.hpp"

#include <atomic>

#include "burin/host/rank_watch.hpp"

namespace burin::host {

namespace {

std::atomic<int> receivedSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not lock");

void remember(int signal) {
  RankWatch::reportLost();  // the launcher ends us so when it has lost a rank
  RankWatch::leave();
  receivedSignal.store(signal);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  struct sigaction action {};
  action.sa_handler = remember;
  // Restart: a library's interrupted read or write must not become an error of ours.
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &previousInt_);
  sigaction(SIGTERM, &action, &previousTerm_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &previousInt_, nullptr);
  sigaction(SIGTERM, &previousTerm_, nullptr);
}

int interruptSignal() {
  return receivedSignal.load();
}

}  // namespace burin::host
