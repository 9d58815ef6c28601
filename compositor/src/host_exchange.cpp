#include "burin/compositor/host_exchange.hpp"

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <ctime>

namespace burin::compositor {

namespace {

using Word = std::atomic<std::uint32_t>;
static_assert(sizeof(Word) == 4 && Word::is_always_lock_free);  // the kernel looks at it, too

void wake(Word& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

/// Sleeps while `word` is `value`, for 100 ms at most; returns early for no reason now and then.
/// Whether the time has passed.
bool sleepWhile(Word& word, std::uint32_t value) {
  constexpr timespec kLongest{0, 100'000'000};
  return syscall(SYS_futex, &word, FUTEX_WAIT, value, &kLongest, nullptr, 0) != 0 &&
         errno == ETIMEDOUT;
}

/// Waits until `isDone(value of word)`: yields for 20 us, since the rank waited for may want this
/// very core, then sleeps.
template <typename IsDone>
void waitFor(Word& word, const char* what, IsDone&& isDone) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const std::uint32_t value = word.load(std::memory_order_acquire);
    if (isDone(value)) return;
    if (std::chrono::steady_clock::now() - start < std::chrono::microseconds{20}) {
      sched_yield();
    } else if (sleepWhile(word, value)) {
      watchWait(what);
    }
  }
}

constexpr std::size_t kLine = 64;

}  // namespace

struct alignas(kLine) HostExchange::Meeting {
  alignas(kLine) Word arrived;
  alignas(kLine) Word number;
};

struct alignas(kLine) HostExchange::Inbox {
  Word letters;  ///< ever put, from anybody
};

/// Letters from one rank to another.
struct alignas(kLine) HostExchange::Mailbox {
  Word put;
  Word taken;
  std::array<Letter, kMostUntaken> letters;
};

std::size_t HostExchange::bytes(int ranks) {
  const auto n = static_cast<std::size_t>(ranks);
  return sizeof(Meeting) + n * sizeof(Inbox) + n * n * sizeof(Mailbox) + 2 * n * kNoticeBytes;
}

HostExchange::HostExchange(std::span<std::byte> memory, Rank rank, int ranks)
    : rank_{static_cast<int>(rank)}, ranks_{ranks} {
  BURIN_CHECK(memory.size() >= bytes(ranks));
  const auto n = static_cast<std::size_t>(ranks);
  std::byte* next = memory.data();
  // All zeros is the initial state of every part.
  meeting_ = reinterpret_cast<Meeting*>(next);
  inboxes_ = reinterpret_cast<Inbox*>(next += sizeof(Meeting));
  mailboxes_ = reinterpret_cast<Mailbox*>(next += n * sizeof(Inbox));
  notices_ = next + n * n * sizeof(Mailbox);
}

std::span<std::byte> HostExchange::notice(std::uint32_t meeting, int rank) const {
  const auto index = static_cast<std::size_t>(meeting % 2) * static_cast<std::size_t>(ranks_) +
                     static_cast<std::size_t>(rank);
  return {notices_ + index * kNoticeBytes, kNoticeBytes};
}

std::vector<std::byte> HostExchange::allGather(std::span<const std::byte> mine) {
  BURIN_CHECK(mine.size() <= kNoticeBytes);
  const std::uint32_t number = meeting_->number.load(std::memory_order_acquire);
  std::ranges::copy(mine, notice(number, rank_).begin());
  if (meeting_->arrived.fetch_add(1, std::memory_order_acq_rel) + 1 ==
      static_cast<std::uint32_t>(ranks_)) {
    meeting_->arrived.store(0, std::memory_order_relaxed);
    meeting_->number.store(number + 1, std::memory_order_release);
    wake(meeting_->number);
  } else {
    waitFor(meeting_->number, "all ranks of this host",
            [&](std::uint32_t now) { return now != number; });
  }
  std::vector<std::byte> all;
  all.reserve(mine.size() * static_cast<std::size_t>(ranks_));
  for (int rank = 0; rank < ranks_; ++rank) {
    const auto theirs = notice(number, rank).first(mine.size());
    all.insert(all.end(), theirs.begin(), theirs.end());
  }
  return all;
}

HostExchange::Mailbox& HostExchange::mailbox(Rank sender, Rank receiver) const {
  return mailboxes_[static_cast<std::size_t>(receiver) * static_cast<std::size_t>(ranks_) +
                    static_cast<std::size_t>(sender)];
}

void HostExchange::put(Rank receiver, SharedPlace place, std::size_t bytes) {
  Mailbox& box = mailbox(Rank{rank_}, receiver);
  const std::uint32_t count = box.put.load(std::memory_order_relaxed);
  if (count - box.taken.load(std::memory_order_acquire) >= kMostUntaken) {
    fail(ExitCode::kRank, "rank {} has not taken {} messages", static_cast<int>(receiver),
         kMostUntaken);
  }
  box.letters[count % kMostUntaken] = {place, bytes};
  box.put.store(count + 1, std::memory_order_release);
  Word& inbox = inboxes_[static_cast<std::size_t>(receiver)].letters;
  inbox.fetch_add(1, std::memory_order_acq_rel);
  wake(inbox);
}

void HostExchange::take(std::span<const Rank> senders,
                        const std::function<void(std::size_t, const Letter&)>& use) {
  std::vector<bool> isTaken(senders.size(), false);
  std::size_t left = senders.size();
  waitFor(inboxes_[static_cast<std::size_t>(rank_)].letters, "pixels of this host's ranks",
          [&](std::uint32_t) {
            for (std::size_t i = 0; i < senders.size(); ++i) {
              Mailbox& box = mailbox(senders[i], Rank{rank_});
              const std::uint32_t taken = box.taken.load(std::memory_order_relaxed);
              if (isTaken[i] || box.put.load(std::memory_order_acquire) == taken) continue;
              const Letter letter = box.letters[taken % kMostUntaken];
              box.taken.store(taken + 1, std::memory_order_release);
              isTaken[i] = true;
              --left;
              use(i, letter);
            }
            return left == 0;
          });
}

void HostFlow::send(Rank receiver, Tag, std::span<const std::byte> message) {
  // One that is nowhere arrives as an empty one, which is an error there: nobody waits for ever.
  const auto place = spaces_->find(message);
  exchange_->put(receiver, place.value_or(SharedPlace{}), place ? message.size() : 0);
}

void HostFlow::receive(Tag tag, std::span<Received> messages, const Room& room) {
  receiveEach(tag, messages, room, [](std::size_t) {});
}

void HostFlow::receiveEach(Tag, std::span<Received> messages, const Room&,
                           const std::function<void(std::size_t)>& use) {
  std::vector<Rank> senders;
  for (const Received& message : messages) senders.push_back(message.sender);
  exchange_->take(senders, [&](std::size_t i, const HostExchange::Letter& letter) {
    messages[i].bytes = spaces_->at(letter.place, static_cast<std::size_t>(letter.bytes))
                            .value_or(std::span<const std::byte>{});
    use(i);
  });
}

}  // namespace burin::compositor
