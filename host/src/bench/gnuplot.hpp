#pragma once

#include <filesystem>

namespace burin::host::bench {

/// Local. Runs gnuplot on `script`, a file in `folder`, with that folder as its working directory.
/// Returns false if no gnuplot is installed. Throws Error{kRank} if it fails.
bool runGnuplot(const std::filesystem::path& folder, const std::filesystem::path& script);

}  // namespace burin::host::bench
