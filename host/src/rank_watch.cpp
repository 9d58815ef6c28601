#include "burin/host/rank_watch.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/compositor/host_memory.hpp"

namespace burin::host {

namespace {

/// A rank's word in the memory that it shares.
enum State : std::uint32_t { kRunning = 0, kLeaving, kReported };
using Word = std::atomic<std::uint32_t>;
static_assert(Word::is_always_lock_free, "a signal handler may not lock");

/// Another rank of this host. Its end is seen by a descriptor of the process, which cannot mean
/// another process later.
struct Neighbour {
  Word* state;
  int process;       ///< pidfd, -1 if the kernel gives none
  std::string last;  ///< what is said if it is lost; made beforehand, for signal handlers
};

struct Watch {
  compositor::HostMemory memory;
  Word* mine;
  std::vector<Neighbour> neighbours;
  std::string waiting;  ///< what is said of this rank, before what it waits for
  struct sigaction previousInt {};
  struct sigaction previousTerm {};
};

/// Signal handlers have no other way to it. Set while all of it is valid.
std::atomic<Watch*> current{nullptr};
std::unique_ptr<Watch> owned;

/// What makes a process known to others: its number means something within its name space only.
struct Identity {
  std::int64_t process;
  std::uint64_t nameSpace;
};

Identity identity() {
  struct stat facts {};
  const bool isKnown = ::stat("/proc/self/ns/pid", &facts) == 0;
  return {::getpid(), isKnown ? facts.st_ino : 0};
}

bool hasEnded(int process) {
  pollfd poll{process, POLLIN, 0};
  return ::poll(&poll, 1, 0) == 1;
}

/// Signals that end a rank during set-up: the launcher's, when another rank is lost.
void onTermination(int signal) {
  RankWatch::reportLost();
  RankWatch::leave();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// One line in one piece, without allocating. Standard error may be gone; there is nobody to tell.
void say(std::array<std::string_view, 4> parts) {
  std::array<iovec, 4> pieces{};
  for (std::size_t i = 0; i < parts.size(); ++i)
    pieces[i] = {const_cast<char*>(parts[i].data()), parts[i].size()};
  [[maybe_unused]] const ssize_t written =
      ::writev(STDERR_FILENO, pieces.data(), static_cast<int>(pieces.size()));
}

Word* wordOf(std::span<std::byte> memory) {
  return reinterpret_cast<Word*>(memory.data());  // zeros at first: kRunning
}

std::vector<Neighbour> neighboursOf(const Communicator& comm,
                                    const compositor::HostMemory& memory) {
  std::vector<Neighbour> neighbours;
  const Identity mine = identity();
  const auto all = allGather(comm, mine);
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    const auto space = memory.of(Rank{static_cast<int>(rank)});
    const bool isMe = Rank{static_cast<int>(rank)} == comm.rank();
    if (isMe || space.empty() || all[rank].nameSpace != mine.nameSpace) continue;
    const auto process = static_cast<int>(::syscall(SYS_pidfd_open, all[rank].process, 0));
    if (process < 0) continue;
    neighbours.push_back(
        {wordOf(space), process,
         fmt::format("burin: rank {} (process {}) has ended without a word: killed, perhaps for "
                     "want of memory, or crashed",
                     rank, all[rank].process)});
  }
  return neighbours;
}

}  // namespace

RankWatch::RankWatch(const Communicator& comm) {
  BURIN_CHECK(!owned);
  owned.reset(new Watch{compositor::HostMemory{comm}, nullptr, {}, {}});
  Watch& watch = *owned;
  if (!watch.memory.isSharing()) return;  // no other rank on any host, or it cannot be seen
  watch.mine = wordOf(watch.memory.own());
  watch.neighbours = neighboursOf(comm, watch.memory);
  watch.waiting = fmt::format("; rank {} waited for ", static_cast<int>(comm.rank()));
  barrier(comm);  // all look before anybody may end
  current.store(&watch);
  struct sigaction action {};
  action.sa_handler = onTermination;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &watch.previousInt);
  sigaction(SIGTERM, &action, &watch.previousTerm);
  setWaitWatch([&comm](const char* what) {
    if (!reportLost(what)) return;
    leave();
    MPI_Abort(comm.get(), static_cast<int>(ExitCode::kRank));
  });
}

RankWatch::~RankWatch() {
  leave();
  if (current.exchange(nullptr) != nullptr) {
    setWaitWatch({});
    sigaction(SIGINT, &owned->previousInt, nullptr);
    sigaction(SIGTERM, &owned->previousTerm, nullptr);
  }
  for (const Neighbour& neighbour : owned->neighbours) ::close(neighbour.process);
  owned.reset();
}

void RankWatch::leave() noexcept {
  if (const Watch* watch = current.load()) watch->mine->store(kLeaving);
}

bool RankWatch::reportLost(const char* awaited) noexcept {
  const Watch* const watch = current.load();
  if (watch == nullptr) return false;
  const int errorBefore = errno;  // of what a signal interrupts
  bool isAny = false;
  for (const Neighbour& neighbour : watch->neighbours) {
    if (!hasEnded(neighbour.process)) continue;
    isAny = true;
    std::uint32_t expected = kRunning;
    // Of all who see it one changes the word, and speaks.
    if (neighbour.state->compare_exchange_strong(expected, kReported))
      say({neighbour.last, awaited != nullptr ? watch->waiting : "",
           awaited != nullptr ? awaited : "", "\n"});
  }
  errno = errorBefore;
  return isAny;
}

}  // namespace burin::host
