#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/common/trace.hpp"

namespace burin::host {

/// One rank's part of the document: its name and its events, "complete" ones ("ph": "X") in
/// microseconds from `zero`, which no event may precede. Entries of a JSON list, without brackets.
std::string traceEntries(int rank, std::span<const TraceEvent> events,
                         std::chrono::steady_clock::time_point zero);

/// Collective. Writes what all ranks have recorded in Chrome's trace event format, a thread for
/// each rank, times by rank 0's clock; how exact that is stands under "otherData". Throws
/// SharedError if the file cannot be written.
void writeTrace(const Communicator& comm, const TraceRecording& mine,
                const std::filesystem::path& target);

}  // namespace burin::host
