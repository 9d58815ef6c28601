#pragma once

#include <string>
#include <vector>

#include "burin/host/command_line.hpp"
#include "options/option_list.hpp"

namespace burin::host {

/// INPUT, --volume, --out and --quick; `quick` is the help of the last.
void addBenchOptions(OptionList& list, BenchOptions& options, const std::string& quick);

/// --repeats, `least` or more; the default is what `repeats` holds.
Option addRepeats(OptionList& list, int& repeats, int least);

/// --size, pixels along each side of square frames; the default is what `side` holds.
Option addFrameSize(OptionList& list, int& side);

/// For benchmarks whose --size (`side`) is that of built-in volumes. Throws Error{kUsage} if it is
/// given beside INPUT or --volume, or if these exclude each other.
void checkBuiltInSize(const BenchOptions& options, const Option& size, int side);

/// Ascending, each once.
void sortUnique(std::vector<int>& numbers);

}  // namespace burin::host
