#include "burin/compositor/cost_model.hpp"

#include <algorithm>
#include <compare>
#include <queue>
#include <utility>

#include "burin/common/error.hpp"
#include "cost_timeline.hpp"
#include "messages_in_flight.hpp"
#include "plan_store.hpp"

namespace burin::compositor {

namespace {

struct Message {
  int receiver = 0;
  double pixels = 0.0;
  double arrived = 0.0;
  Region region;
  Block block;
};

struct Participant {
  Block block;
  std::size_t next = 0;     ///< step it is at
  std::size_t missing = 0;  ///< messages of the round it waits for that have not begun to arrive
  Region awaited;           ///< that round's region
  double time = 0.0;        ///< until when it has been followed
  double work = 0.0;        ///< the combining it is about to do
  Link in, out;
  std::vector<Message> inbox;
  Region owned;
  double messages = 0.0, sentBytes = 0.0, receivedBytes = 0.0;
  int rounds = 0;
};

/// A participant goes on, or a message begins to arrive.
struct Event {
  double time = 0.0;
  bool isMessage = false;
  std::size_t index = 0;
  friend auto operator<=>(const Event&, const Event&) = default;
};

class Simulation {
 public:
  Simulation(const LazySchedule& schedule, const ActivePixels& activePixels, const WireSize& wire,
             const Machine& machine)
      : activePixels_{activePixels},
        wire_{wire},
        machine_{machine},
        plans_{schedule},
        cores_{machine.cores},
        participants_(static_cast<std::size_t>(schedule.participants)) {
    for (std::size_t i = 0; i < participants_.size(); ++i) {
      participants_[i].block = {static_cast<int>(i), static_cast<int>(i) + 1};
      events_.push({0.0, false, i});
    }
  }

  Prediction run(int root) {
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      if (event.isMessage) {
        arrive(event);
      } else {
        advance(event.index);
      }
    }
    BURIN_CHECK_EQ(finished_, participants_.size());
    Prediction result = counts();
    result.gatherSeconds = gatherSeconds(root, result.compositeSeconds);
    return result;
  }

 private:
  /// One step only, so that all go through time together and share cores fairly.
  void advance(std::size_t self) {
    Participant& mine = participants_[self];
    const Plan& plan = plans_.get(static_cast<int>(self));
    if (mine.work > 0.0) {
      mine.time = cores_.compute(mine.time, std::exchange(mine.work, 0.0));
      events_.push({mine.time, false, self});
    } else if (mine.next == plan.steps.size()) {
      mine.owned = plan.owned;
      ++finished_;
    } else if (const Step& step = plan.steps[mine.next]; step.kind == Step::Kind::kSend) {
      send(self, step);
    } else {
      await(self, step.region, roundEnd(plan.steps, mine.next) - mine.next);
    }
  }

  void send(std::size_t self, const Step& step) {
    Participant& mine = participants_[self];
    const double pixels = activePixels_(step.region, mine.block.front, mine.block.back);
    const double bytes = messageBytes(wire_, pixels);
    mine.time = cores_.compute(mine.time, handling(machine_, bytes));
    const double left = mine.out.carry(machine_.link, mine.time, bytes);
    mine.messages += 1.0;
    mine.sentBytes += bytes;
    ++mine.next;
    events_.push({mine.time, false, self});
    // The receiver's link carries it at the same time, only later by the latency.
    const double begins = left - bytes * machine_.link.gapPerByte + machine_.link.latency;
    events_.push({begins, true, place({step.peer, pixels, 0.0, step.region, mine.block})});
  }

  std::size_t place(const Message& message) {
    if (free_.empty()) {
      messages_.push_back(message);
      return messages_.size() - 1;
    }
    const std::size_t index = free_.back();
    free_.pop_back();
    messages_[index] = message;
    return index;
  }

  void arrive(const Event& event) {
    Message message = messages_[event.index];
    free_.push_back(event.index);
    const auto receiver = static_cast<std::size_t>(message.receiver);
    Participant& mine = participants_[receiver];
    const double bytes = messageBytes(wire_, message.pixels);
    message.arrived = mine.in.carry(machine_.link, event.time, bytes);
    mine.receivedBytes += bytes;
    mine.inbox.push_back(message);
    if (mine.missing > 0 && message.region == mine.awaited && --mine.missing == 0) {
      combine(receiver);
    }
  }

  void await(std::size_t self, const Region& region, std::size_t messages) {
    Participant& mine = participants_[self];
    const auto there =
        static_cast<std::size_t>(std::ranges::count(mine.inbox, region, &Message::region));
    BURIN_CHECK(there <= messages);
    mine.awaited = region;
    mine.missing = messages - there;
    mine.next += messages;
    ++mine.rounds;
    if (mine.missing == 0) combine(self);
  }

  /// All of a round is arriving; combining begins when the last message is through.
  void combine(std::size_t self) {
    Participant& mine = participants_[self];
    for (const Message& message : mine.inbox) {
      if (message.region != mine.awaited) continue;
      mine.time = std::max(mine.time, message.arrived);
      mine.block.front = std::min(mine.block.front, message.block.front);
      mine.block.back = std::max(mine.block.back, message.block.back);
      mine.work += handling(machine_, messageBytes(wire_, message.pixels)) +
                   machine_.compute.perCombinedPixel * message.pixels;
    }
    std::erase_if(mine.inbox, [&](const Message& m) { return m.region == mine.awaited; });
    events_.push({mine.time, false, self});
  }

  Prediction counts() const {
    Prediction result;
    for (const Participant& each : participants_) {
      result.compositeSeconds = std::max(result.compositeSeconds, each.time);
      result.messages += each.messages;
      result.bytes += each.sentBytes;
      result.mostMessages = std::max(result.mostMessages, each.messages);
      result.mostSentBytes = std::max(result.mostSentBytes, each.sentBytes);
      result.mostReceivedBytes = std::max(result.mostReceivedBytes, each.receivedBytes);
      result.mostRounds = std::max(result.mostRounds, each.rounds);
    }
    return result;
  }

  double gatherSeconds(int root, double composited) {
    std::vector<FinishedPiece> pieces;
    double rootTime = 0.0;
    for (int i = 0; i < static_cast<int>(participants_.size()); ++i) {
      const Participant& each = participants_[static_cast<std::size_t>(i)];
      if (i == root) rootTime = each.time;
      if (i == root || each.owned.empty()) continue;
      const double pixels = activePixels_(each.owned, each.block.front, each.block.back);
      pieces.push_back({each.time, messageBytes(wire_, pixels)});
    }
    std::ranges::sort(pieces, {}, &FinishedPiece::time);
    return std::max(0.0, gatherEnd(pieces, rootTime, machine_, cores_) - composited);
  }

  const ActivePixels& activePixels_;
  WireSize wire_;
  Machine machine_;
  PlanStore plans_;
  Cores cores_;
  std::vector<Participant> participants_;
  std::vector<Message> messages_;  ///< that have not begun to arrive, and free places
  std::vector<std::size_t> free_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::size_t finished_ = 0;
};

}  // namespace

Prediction predict(const LazySchedule& schedule, const ActivePixels& activePixels,
                   const WireSize& wire, const Machine& machine, int root) {
  return Simulation{schedule, activePixels, wire, machine}.run(root);
}

}  // namespace burin::compositor
