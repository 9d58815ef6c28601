#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "burin/compositor/received.hpp"

namespace burin::compositor {

/// The messages between the threads of one process that play ranks. Messages are not copied: they
/// stay where the sender made them until the frame is done.
class Mailboxes {
 public:
  void put(Rank sender, Rank receiver, Tag tag, std::span<const std::byte> message);
  /// Waits.
  std::span<const std::byte> take(Rank sender, Rank receiver, Tag tag);

 private:
  using Box = std::tuple<Rank, Rank, Tag>;
  std::mutex mutex_;
  std::condition_variable hasMail_;
  std::map<Box, std::deque<std::span<const std::byte>>> boxes_;
};

/// A MessageFlow (executor.hpp) between threads; one per thread.
class InProcessFlow {
 public:
  InProcessFlow(Mailboxes& mailboxes, Rank self) : mailboxes_{&mailboxes}, self_{self} {}

  using Room = std::function<std::span<std::byte>(std::size_t bytes)>;

  void send(Rank receiver, Tag tag, std::span<const std::byte> message) {
    mailboxes_->put(self_, receiver, tag, message);
  }
  void receive(Tag tag, std::span<Received> messages, const Room& room) {
    receiveEach(tag, messages, room, [](std::size_t) {});
  }
  void receiveEach(Tag tag, std::span<Received> messages, const Room& room,
                   const std::function<void(std::size_t index)>& use);
  void finish() {}

 private:
  Mailboxes* mailboxes_;
  Rank self_;
};

}  // namespace burin::compositor
