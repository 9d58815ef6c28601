#pragma once

#include <span>
#include <string>

#include "bench/compositing_measurement.hpp"

namespace burin::host::bench {

/// A gnuplot script that draws, from the compositing.csv beside it, those of these pictures whose
/// measurements there are: compositing_time.png and compositing_bytes.png against ranks,
/// compositing_size.png against the frame's side, compositing_active.png against the active
/// fraction. burin's schedules are thick lines with dotted ones for what the model predicts, IceT's
/// strategies thin and dashed.
std::string compositingPlots(std::span<const CompositingMeasurement> rows);

}  // namespace burin::host::bench
