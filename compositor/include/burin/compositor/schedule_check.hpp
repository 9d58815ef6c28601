#pragma once

#include <optional>
#include <string>

#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// Runs a schedule on symbols instead of pixels and says what is wrong with it first, or nullopt if
/// it is sound: each send has its receive and the other way round, nobody waits for ever, only
/// pixels still held are sent or combined, none is lost, every pixel is combined exactly once with
/// each participant and only with its neighbours in visibility order, and in the end the owned
/// regions are complete and cover `all` once.
///
/// Time grows with the number of steps. What is in flight is kept as runs of like messages, so
/// memory grows with participants and rounds only. Plans are asked for once per round.
std::optional<std::string> scheduleProblem(const LazySchedule& schedule);
std::optional<std::string> scheduleProblem(const Schedule& schedule);

}  // namespace burin::compositor
