#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/compositor/received.hpp"
#include "burin/compositor/shared_spaces.hpp"

namespace burin::compositor {

/// Meeting points and mailboxes for ranks that are all on one host, in shared memory: everybody
/// wakes up once per meeting, where MPI's collectives take a chain of messages, each of which waits
/// for a process to be scheduled. Waits sleep in the kernel.
///
/// A meeting's area is used again at the meeting after the next one; that nobody still reads it
/// then follows from the meeting in between.
class HostExchange {
 public:
  /// Bytes a rank can tell the others in one meeting.
  static constexpr std::size_t kNoticeBytes = 1280;

  /// Bytes of memory it needs, zeros at first and the same for all ranks.
  static std::size_t bytes(int ranks);
  /// `memory`: mapped by all ranks.
  HostExchange(std::span<std::byte> memory, Rank rank, int ranks);

  /// Collective. Every rank's bytes (equal sizes, at most kNoticeBytes) in rank order.
  std::vector<std::byte> allGather(std::span<const std::byte> mine);

  /// Local. Tells `receiver` where a message lies; never waits. Throws Error{kRank} if it has not
  /// taken the kMostUntaken before.
  void put(Rank receiver, SharedPlace place, std::size_t bytes);
  /// A message's place and length.
  struct Letter {
    SharedPlace place;
    std::uint64_t bytes = 0;
  };
  /// Waits until `use(letter)` has been called for the next letter of each of `senders` (a rank may
  /// be named more than once), in any order between senders.
  void take(std::span<const Rank> senders,
            const std::function<void(std::size_t index, const Letter&)>& use);

  static constexpr std::uint32_t kMostUntaken = 16;

 private:
  struct Meeting;
  struct Inbox;
  struct Mailbox;
  Mailbox& mailbox(Rank sender, Rank receiver) const;
  std::span<std::byte> notice(std::uint32_t meeting, int rank) const;

  Meeting* meeting_;
  Inbox* inboxes_;      ///< by receiver
  Mailbox* mailboxes_;  ///< by receiver and sender
  std::byte* notices_;
  int rank_, ranks_;
};

/// A MessageFlow (executor.hpp) between the ranks of one host: messages stay where the sender made
/// them, in memory that it shares, and are read there.
class HostFlow {
 public:
  HostFlow(HostExchange& exchange, const SharedSpaces& spaces)
      : exchange_{&exchange}, spaces_{&spaces} {}

  using Room = std::function<std::span<std::byte>(std::size_t bytes)>;

  /// `message` lies in this rank's shared memory.
  void send(Rank receiver, Tag tag, std::span<const std::byte> message);
  void receive(Tag tag, std::span<Received> messages, const Room& room);
  void receiveEach(Tag tag, std::span<Received> messages, const Room& room,
                   const std::function<void(std::size_t index)>& use);
  void finish() {}

 private:
  HostExchange* exchange_;
  const SharedSpaces* spaces_;
};

}  // namespace burin::compositor
