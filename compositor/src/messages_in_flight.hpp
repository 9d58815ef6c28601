#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// Participants [front, back), whose pixels have been combined.
struct Block {
  int front = 0;
  int back = 0;
  friend bool operator==(const Block&, const Block&) = default;
};

/// What has been sent to one participant and not been received yet: of each message its sender,
/// region and the block it combines. Consecutive messages of one region whose senders and blocks
/// are equally spaced are one run, so a whole round takes the room of one message or two.
class MessagesInFlight {
 public:
  struct Message {
    int sender = 0;
    Region region;
    Block block;
  };
  void add(const Message& message);
  /// The region of the oldest message of `sender`, if there is one.
  std::optional<Region> regionFrom(int sender) const;
  /// Takes the oldest message of `sender` out; there must be one.
  Message take(int sender);
  bool empty() const { return runs_.empty(); }
  int anySender() const { return runs_.front().first.sender; }

 private:
  struct Run {
    Message first;
    int count = 1;
    int senderStep = 0;  ///< from one message to the next; blocks of equal size, `blockStep` apart
    int blockStep = 0;

    Message at(int index) const;
    std::optional<int> indexOf(int sender) const;
    bool extend(const Message& message);
  };
  std::size_t findRun(int sender) const;  ///< runs_.size() if none

  std::vector<Run> runs_;  ///< in the order they were sent
};

}  // namespace burin::compositor
