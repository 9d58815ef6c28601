#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace burin::host::bench {

/// A line of a benchmark's summary: what was measured beside its target, and whether that is met;
/// "" if nothing was measured. `most`, `least`: the target, which itself is still met.
std::string atMostLine(std::string_view what, std::optional<double> measured, double most);
std::string atLeastLine(std::string_view what, std::optional<double> measured, double least);

}  // namespace burin::host::bench
