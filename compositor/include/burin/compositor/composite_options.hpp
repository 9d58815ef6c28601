#pragma once

#include <optional>

#include "burin/common/communicator.hpp"
#include "burin/compositor/schedule.hpp"
#include "burin/compositor/schedule_choice.hpp"

namespace burin::compositor {

/// Whether pixels that leave a host are packed with zstd, which loses nothing.
enum class Packing { kAuto, kNever, kAlways };

/// How a frame is composited; the same on every rank.
struct CompositeOptions {
  /// Not given: chosen by chooseSchedule() from counters and the link.
  std::optional<ScheduleOptions> schedule;
  /// What the ranks are joined by. Not given: shared memory if all are on one host, else fast. The
  /// choice of a schedule follows what is declared and never a clock, so that the same scene on the
  /// same ranks always gives the same bits.
  std::optional<LinkClass> link;
  Packing packing = Packing::kAuto;
  /// Ranks of one host hand pixels over by reference. Changes no bit of the picture; off only to
  /// compare.
  bool isSharingMemory = true;
  Rank root{0};  ///< where frames are gathered; need not have drawn anything
};

/// Whether zstd packs what leaves a host, as far as it was declared.
inline std::optional<bool> declaredPacking(const CompositeOptions& options) {
  if (options.packing != Packing::kAuto) return options.packing == Packing::kAlways;
  if (options.link) return *options.link == LinkClass::kSlow;
  return std::nullopt;
}

}  // namespace burin::compositor
