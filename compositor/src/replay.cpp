#include "burin/compositor/replay.hpp"

#include <algorithm>
#include <compare>
#include <functional>
#include <queue>
#include <vector>

#include "burin/common/error.hpp"
#include "cost_timeline.hpp"

namespace burin::compositor {

namespace {

using Kind = TraceStep::Kind;
using Channel = TraceStep::Channel;

struct Message {
  int sender = 0;
  int receiver = 0;
  Channel channel = Channel::kSwap;
  bool isPacked = false;
  double bytes = 0.0, wireBytes = 0.0;
  bool isAwaited = false;  ///< the receiver has said so
  bool hasLeft = false;
  bool isThere = false;
  bool isTaken = false;
  double ready = 0.0;  ///< when the sender had made it
};

struct RankState {
  std::size_t next = 0;
  std::size_t groupEnd = 0;  ///< of the receives it waits in, if it does
  std::size_t missing = 0;
  std::size_t staying = 0;  ///< messages sent that have not left
  bool isFinishing = false;
  double sentUntil = 0.0;
  double time = 0.0;
  Link in, out;
};

struct Event {
  enum class What { kAdvance, kDepart, kBegin, kArrive };
  double time = 0.0;
  What what = What::kAdvance;
  std::size_t index = 0;  ///< of a rank or a message
  friend auto operator<=>(const Event&, const Event&) = default;
};

class Replay {
 public:
  Replay(std::span<const FrameTrace> traces, const ReplayMachine& machine)
      : traces_{traces}, machine_{machine}, cores_{machine.cores}, ranks_(traces.size()) {
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank) push(0.0, What::kAdvance, rank);
  }

  double run() {
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      switch (event.what) {
        case What::kAdvance:
          advance(event.index);
          break;
        case What::kDepart:
          depart(event);
          break;
        case What::kBegin:
          begin(event);
          break;
        case What::kArrive:
          arrive(event);
          break;
      }
    }
    BURIN_CHECK_EQ(ended_, ranks_.size());
    double end = 0.0;
    for (const RankState& rank : ranks_) end = std::max(end, rank.time);
    return end;
  }

 private:
  using What = Event::What;

  void push(double time, What what, std::size_t index) { events_.push({time, what, index}); }

  void advance(std::size_t self) {
    RankState& mine = ranks_[self];
    if (mine.next == traces_[self].size()) {
      ++ended_;
      return;
    }
    const TraceStep& step = traces_[self][mine.next];
    switch (step.kind) {
      case Kind::kReceive:
        await(self);
        return;
      case Kind::kFinish:
        finish(self);
        return;
      case Kind::kSend:
        send(self, step);
        break;
      case Kind::kScan:
        work(mine, machine_.work.perScannedPixel, step.pixels);
        break;
      case Kind::kCombine:
        work(mine, machine_.work.perCombinedPixel, step.pixels);
        break;
      case Kind::kPaste:
        work(mine, machine_.work.perPastedPixel, step.pixels);
        break;
    }
    ++mine.next;
    push(mine.time, What::kAdvance, self);
  }

  void work(RankState& mine, double perPixel, std::int64_t pixels) {
    mine.time = cores_.compute(mine.time, perPixel * static_cast<double>(pixels));
  }

  void send(std::size_t self, const TraceStep& step) {
    RankState& mine = ranks_[self];
    Message message{static_cast<int>(self),
                    step.peer,
                    step.channel,
                    step.isPacked != 0,
                    static_cast<double>(step.bytes),
                    static_cast<double>(step.wireBytes)};
    const WorkRates& rates = machine_.work;
    const double perByte = rates.perEncodedByte + (message.isPacked ? rates.perPackedByte : 0.0);
    mine.time = cores_.compute(mine.time, machine_.link.overhead + perByte * message.bytes);
    message.ready = mine.time;
    ++mine.staying;
    messages_.push_back(message);
    const RankState& receiver = ranks_[static_cast<std::size_t>(step.peer)];
    if (message.wireBytes <= machine_.eagerBytes) {
      push(mine.time, What::kDepart, messages_.size() - 1);
    } else if (isWaitingFor(receiver, message)) {
      invite(messages_.size() - 1, mine.time);
    }
  }

  /// The rendezvous: there and back, then it leaves.
  void invite(std::size_t index, double time) {
    messages_[index].isAwaited = true;
    push(std::max(time, messages_[index].ready) + 2.0 * machine_.link.latency, What::kDepart,
         index);
  }

  bool isWaitingFor(const RankState& receiver, const Message& message) const {
    const auto& steps = traces_[static_cast<std::size_t>(message.receiver)];
    for (std::size_t i = receiver.next; i < receiver.groupEnd; ++i) {
      if (steps[i].peer == message.sender && steps[i].channel == message.channel) return true;
    }
    return false;
  }

  void depart(const Event& event) {
    Message& message = messages_[event.index];
    RankState& sender = ranks_[static_cast<std::size_t>(message.sender)];
    const double left = sender.out.carry(machine_.link, event.time, message.wireBytes);
    message.hasLeft = true;
    sender.sentUntil = std::max(sender.sentUntil, left);
    push(left - message.wireBytes * machine_.link.gapPerByte + machine_.link.latency, What::kBegin,
         event.index);
    if (--sender.staying == 0 && sender.isFinishing) {
      finish(static_cast<std::size_t>(message.sender));
    }
  }

  void begin(const Event& event) {
    const Message& message = messages_[event.index];
    RankState& receiver = ranks_[static_cast<std::size_t>(message.receiver)];
    push(receiver.in.carry(machine_.link, event.time, message.wireBytes), What::kArrive,
         event.index);
  }

  void arrive(const Event& event) {
    Message& message = messages_[event.index];
    message.isThere = true;
    const auto self = static_cast<std::size_t>(message.receiver);
    RankState& mine = ranks_[self];
    if (mine.groupEnd == 0 || !isWaitingFor(mine, message)) return;
    mine.time = std::max(mine.time, event.time);
    take(self, message);
    if (mine.missing == 0) endGroup(self);
  }

  /// Consecutive receives of one channel. A round is taken apart when all of it is there, the
  /// gather message by message.
  void await(std::size_t self) {
    RankState& mine = ranks_[self];
    const FrameTrace& steps = traces_[self];
    mine.groupEnd = mine.next;
    while (mine.groupEnd < steps.size() && steps[mine.groupEnd].kind == Kind::kReceive &&
           steps[mine.groupEnd].channel == steps[mine.next].channel) {
      ++mine.groupEnd;
    }
    mine.missing = mine.groupEnd - mine.next;
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      Message& message = messages_[i];
      if (message.receiver != static_cast<int>(self) || message.isTaken) continue;
      if (!isWaitingFor(mine, message)) continue;
      if (message.isThere) {
        take(self, message);
      } else if (!message.hasLeft && !message.isAwaited &&
                 message.wireBytes > machine_.eagerBytes) {
        invite(i, mine.time);
      }
    }
    if (mine.missing == 0) endGroup(self);
  }

  void take(std::size_t self, Message& message) {
    RankState& mine = ranks_[self];
    message.isTaken = true;
    --mine.missing;
    const WorkRates& rates = machine_.work;
    const double perByte = rates.perDecodedByte + (message.isPacked ? rates.perUnpackedByte : 0.0);
    const double duration = machine_.link.overhead + perByte * message.bytes;
    if (message.channel == Channel::kGather) {
      mine.time = cores_.compute(mine.time, duration);
    } else {
      pending_.resize(ranks_.size());
      pending_[self] += duration;
    }
  }

  void endGroup(std::size_t self) {
    RankState& mine = ranks_[self];
    double duration = pending_.empty() ? 0.0 : std::exchange(pending_[self], 0.0);
    for (; mine.next < mine.groupEnd; ++mine.next) {
      duration +=
          machine_.work.perPastedPixel * static_cast<double>(traces_[self][mine.next].pixels);
    }
    mine.groupEnd = 0;
    mine.time = cores_.compute(mine.time, duration);
    push(mine.time, What::kAdvance, self);
  }

  void finish(std::size_t self) {
    RankState& mine = ranks_[self];
    mine.isFinishing = mine.staying > 0;
    if (mine.isFinishing) return;
    mine.time = std::max(mine.time, mine.sentUntil);
    ++mine.next;
    push(mine.time, What::kAdvance, self);
  }

  std::span<const FrameTrace> traces_;
  ReplayMachine machine_;
  Cores cores_;
  std::vector<RankState> ranks_;
  std::vector<double> pending_;  ///< by rank: taking its round apart
  std::vector<Message> messages_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::size_t ended_ = 0;
};

}  // namespace

double replay(std::span<const FrameTrace> byRank, const ReplayMachine& machine) {
  return Replay{byRank, machine}.run();
}

}  // namespace burin::compositor
