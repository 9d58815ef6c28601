#pragma once

#include <cstddef>

#include "burin/compositor/cost_model.hpp"
#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// What the participants declare their network to be.
enum class LinkClass {
  kSharedMemory,  ///< one host, pixels are handed over by reference
  kFast,          ///< a cluster's network, 10 Gbit/s and more
  kSlow,          ///< Ethernet of 1 Gbit/s and less
};

/// What is assumed of a link class, on order-of-magnitude figures; see schedule_choice.cpp.
/// `cores`: as in Machine.
Machine assumedMachine(LinkClass link, int cores = 0);

/// The schedule that the cost model finds fastest, gather to participant 0 included, for
/// `participants` (>= 1) that drew `activePixelsTotal` pixels all in all in a frame of
/// `framePixels`. Pure and of counts and declarations only, never clocks: all ranks choose alike,
/// and the same scene gives the same picture. If it is a serial gather, the caller sets the
/// collector (the root, if that takes part). `cores` must be given alike on all ranks.
ScheduleOptions chooseSchedule(int participants, std::size_t activePixelsTotal,
                               std::size_t framePixels, LinkClass link, std::size_t bytesPerPixel,
                               int cores = 0);

}  // namespace burin::compositor
