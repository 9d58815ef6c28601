#include <algorithm>
#include <array>
#include <optional>

#include "bench/contender.hpp"
#include "burin/compositor/compositor.hpp"

namespace burin::host::bench {

namespace {

using compositor::CompositeOptions;
using compositor::ScheduleKind;
using compositor::ScheduleOptions;
using compositor::Subimage;
using compositor::SubimageView;

struct NamedSchedule {
  std::string_view name;  ///< as --composite and compositing.csv call it
  std::optional<ScheduleOptions> schedule;
};

const std::array kSchedules{
    NamedSchedule{"auto", std::nullopt},
    NamedSchedule{"swap", ScheduleOptions{.kind = ScheduleKind::kBinarySwap}},
    NamedSchedule{"radix-k", ScheduleOptions{.kind = ScheduleKind::kRadixK}},
    NamedSchedule{"direct", ScheduleOptions{.kind = ScheduleKind::kDirectSend}},
    NamedSchedule{"serial", ScheduleOptions{.kind = ScheduleKind::kSerialGather}}};

/// The only place where the benchmark meets burin's compositor. Images lie in its canvas, where the
/// renderer draws them.
class BurinContender : public Contender {
 public:
  BurinContender(std::shared_ptr<compositor::Compositor> compositor, const NamedSchedule& schedule)
      : compositor_{std::move(compositor)}, name_{schedule.name} {
    options_.schedule = schedule.schedule;
  }

  std::string_view peer() const override { return "burin"; }
  std::string_view schedule() const override { return name_; }

  void setImage(const Subimage<Rgba>& mine) override {
    const auto canvas = compositor_->canvas<Rgba>(mine.frame, mine.pixels.size());
    std::ranges::copy(mine.pixels, canvas.begin());
    mine_.emplace(mine.frame, mine.active, canvas);
  }

  std::span<const Rgba> composite(std::span<const Rank> order, Collect collect) override {
    RankStatistics statistics;
    const auto frame =
        compositor_->toRoot<compositor::Over>(options_, order, *mine_, Outcome{}, statistics);
    bytesSent_ = statistics.bytesSent;
    // Pixels of the gather travel while others are composited: told apart by counting.
    if (collect == Collect::kNo) bytesSent_ -= statistics.bytesToRoot;
    return frame ? frame->pixels() : std::span<const Rgba>{};
  }

  std::int64_t bytesSent() const override { return bytesSent_; }
  const compositor::FrameTrace* lastTrace() const override { return &compositor_->lastTrace(); }

 private:
  std::shared_ptr<compositor::Compositor> compositor_;
  std::string_view name_;
  CompositeOptions options_;
  std::optional<SubimageView<Rgba>> mine_;
  std::int64_t bytesSent_ = 0;
};

}  // namespace

Contenders burinContenders(const Communicator& comm) {
  // One for all schedules: they take turns.
  const auto compositor = std::make_shared<compositor::Compositor>(comm);
  Contenders contenders;
  for (const NamedSchedule& schedule : kSchedules)
    contenders.push_back(std::make_unique<BurinContender>(compositor, schedule));
  return contenders;
}

}  // namespace burin::host::bench
