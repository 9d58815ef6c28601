#include <algorithm>
#include <cmath>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/compositor/cost_model.hpp"
#include "cost_timeline.hpp"

namespace burin::compositor {

namespace {

/// Participant 0, who stands for all. What it is sent comes when its own messages leave.
class Representative {
 public:
  Representative(int participants, const ActivePixels& activePixels, const WireSize& wire,
                 const Machine& machine)
      : participants_{participants}, activePixels_{activePixels}, wire_{wire}, machine_{machine} {
    // If all compute at once, each gets its share of the cores.
    if (machine.cores > 0)
      slowdown_ = std::max(1.0, static_cast<double>(participants) / machine.cores);
  }

  void follow(const Plan& plan) {
    for (std::size_t i = 0; i < plan.steps.size();) {
      if (plan.steps[i].kind == Step::Kind::kSend) {
        send(plan.steps[i].region);
        ++i;
      } else {
        const std::size_t end = roundEnd(plan.steps, i);
        receive(plan.steps[i].region, end - i);
        i = end;
      }
    }
  }

  Prediction counts() const {
    const auto n = static_cast<double>(participants_);
    return {time_, 0.0, sent_ * n, sentBytes_ * n, sent_, sentBytes_, receivedBytes_, rounds_};
  }

  double gatherSeconds(const Region& all, const Region& owned, int root) const {
    if (owned.empty()) return 0.0;
    const auto owners = static_cast<std::size_t>(std::lround(
        static_cast<double>(all.end - all.begin) / static_cast<double>(owned.end - owned.begin)));
    const double bytes = messageBytes(wire_, activePixels_(owned, 0, block_));
    const std::vector<FinishedPiece> pieces(owners - (root == kNoParticipant ? 0 : 1),
                                            {time_, bytes});
    Cores cores{machine_.cores};
    return std::max(0.0, gatherEnd(pieces, time_, machine_, cores) - time_);
  }

 private:
  void send(const Region& region) {
    const double bytes = messageBytes(wire_, activePixels_(region, 0, block_));
    time_ += slowdown_ * handling(machine_, bytes);
    const double left = out_.carry(machine_.link, time_, bytes);
    begins_.push_back(left - bytes * machine_.link.gapPerByte + machine_.link.latency);
    sent_ += 1.0;
    sentBytes_ += bytes;
  }

  void receive(const Region& region, std::size_t messages) {
    const double pixels = activePixels_(region, 0, block_);
    const double bytes = messageBytes(wire_, pixels);
    const double work = handling(machine_, bytes) + machine_.compute.perCombinedPixel * pixels;
    // Who sends nothing (a collector) gets what the others send at first.
    double begins = handling(machine_, bytes) * slowdown_ + machine_.link.latency;
    for (std::size_t i = 0; i < messages; ++i) {
      if (matched_ < begins_.size()) begins = begins_[matched_++];
      time_ = std::max(time_, in_.carry(machine_.link, begins, bytes));
    }
    const auto count = static_cast<double>(messages);
    time_ += slowdown_ * work * count;
    receivedBytes_ += bytes * count;
    block_ = static_cast<int>(std::min<double>(participants_, block_ * (count + 1.0)));
    ++rounds_;
  }

  int participants_;
  const ActivePixels& activePixels_;
  WireSize wire_;
  Machine machine_;
  double slowdown_ = 1.0;
  Link in_, out_;
  std::vector<double> begins_;  ///< when the messages sent begin to arrive at somebody's
  std::size_t matched_ = 0;     ///< how many of them stood for one received
  int block_ = 1;
  double time_ = 0.0, sent_ = 0.0, sentBytes_ = 0.0, receivedBytes_ = 0.0;
  int rounds_ = 0;
};

}  // namespace

Prediction predictAlike(const LazySchedule& schedule, const ActivePixels& activePixels,
                        const WireSize& wire, const Machine& machine, int root) {
  BURIN_CHECK(schedule.participants >= 1);
  Representative representative{schedule.participants, activePixels, wire, machine};
  const Plan plan = schedule.plan(0);
  representative.follow(plan);
  Prediction result = representative.counts();
  result.gatherSeconds = representative.gatherSeconds(schedule.all, plan.owned, root);
  return result;
}

}  // namespace burin::compositor
