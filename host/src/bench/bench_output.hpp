#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace burin::host::bench {

/// What a benchmark leaves, as texts.
struct BenchOutput {
  std::string name;  ///< of the files
  std::string csv;
  std::string plots;    ///< a gnuplot script that reads NAME.csv
  std::string summary;  ///< for standard output
  std::size_t measurements = 0;
};

/// Local. Writes NAME.csv and NAME.gp to `folder`, prints the summary, and draws the plots where
/// gnuplot is installed. Throws as writeTextFile and runGnuplot do.
void publish(const std::filesystem::path& folder, const BenchOutput& output);

}  // namespace burin::host::bench
