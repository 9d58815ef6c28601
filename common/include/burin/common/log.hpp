#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace burin {

/// Lines on stderr, each begun with "burin: ". Warnings are shown always, notes unless quiet.
/// Rank 0 speaks for all unless the caller decides otherwise.
void setQuiet(bool quiet);
void writeLog(std::string_view prefix, std::string_view line, bool suppressedWhenQuiet);

template <typename... Args>
void note(fmt::format_string<Args...> format, Args&&... args) {
  writeLog("", fmt::format(format, std::forward<Args>(args)...), true);
}
template <typename... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  writeLog("warning: ", fmt::format(format, std::forward<Args>(args)...), false);
}

}  // namespace burin
