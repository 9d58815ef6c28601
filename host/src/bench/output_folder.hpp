#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace burin::host::bench {

/// Local. Makes the folder that --out names if it is not there. Throws Error{kUsage} if that cannot
/// be or if `table` cannot be written in it.
void createOutputFolder(const std::filesystem::path& folder, std::string_view table);

/// What a table calls a file: its name, with nothing in it that the table or gnuplot would take for
/// something else.
std::string tableName(const std::filesystem::path& file);

}  // namespace burin::host::bench
