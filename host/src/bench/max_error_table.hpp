#pragma once

#include <span>
#include <string>

#include "bench/max_error_measurement.hpp"

namespace burin::host::bench {

/// max_error.csv: a header line and a line per picture. Steps and samples of fixed steps are 0
/// where none was good enough.
std::string maxErrorCsv(std::span<const MaxErrorMeasurement> rows);

/// For people: per volume and transfer function how asked and measured errors and samples compare,
/// and how many pictures kept what was asked.
std::string maxErrorSummary(std::span<const MaxErrorMeasurement> rows);

}  // namespace burin::host::bench
