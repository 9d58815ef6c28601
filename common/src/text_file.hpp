#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace burin {

/// A whole text file that people wrote, at most 16 MiB: a volume given by mistake is refused before
/// it is read. `what` it should be stands in messages: "the scene". Throws Error{kUsage}.
std::string readSmallFile(const std::filesystem::path& file, std::string_view what);

}  // namespace burin
