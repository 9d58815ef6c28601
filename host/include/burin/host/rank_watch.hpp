#pragma once

#include "burin/common/communicator.hpp"

namespace burin::host {

/// While it lives, a rank that dies without a word (killed, out of memory, crashed) is named once,
/// by one of the other ranks of its host, and the job is aborted with exit code 4 if the launcher
/// does not end it first. They learn of it from the kernel, in every wait and when the launcher
/// terminates them for it. Ranks of other hosts depend on the launcher, which ends them. One at a
/// time in a process.
class RankWatch {
 public:
  /// Collective. `comm` must outlive it.
  explicit RankWatch(const Communicator& comm);
  ~RankWatch();
  RankWatch(const RankWatch&) = delete;
  RankWatch& operator=(const RankWatch&) = delete;

  /// From now on this rank may end whenever it likes, as it says itself why.
  static void leave() noexcept;
  /// Names the ranks that are lost, if nobody has yet, on standard error, and what this rank
  /// `awaited` meanwhile, if anything. Whether any of this host have ended, with or without a word.
  /// May be called in a signal handler.
  static bool reportLost(const char* awaited = nullptr) noexcept;
};

}  // namespace burin::host
