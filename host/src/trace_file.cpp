#include "burin/host/trace_file.hpp"

#include <algorithm>

#include "burin/common/clock_offset.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

/// Collective. On rank 0 the texts of all ranks one after the other, elsewhere nothing.
std::string gatherTexts(const Communicator& comm, const std::string& mine) {
  std::vector<int> counts, offsets;
  std::size_t total = 0;
  for (const std::uint64_t count : allGather(comm, std::uint64_t{mine.size()})) {
    offsets.push_back(mpiCount(total));
    counts.push_back(mpiCount(count));
    total += count;
  }
  std::string all(comm.isRoot() ? total : 0, '\0');
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Igatherv(mine.data(), mpiCount(mine.size()), MPI_CHAR, all.data(), counts.data(),
                        offsets.data(), MPI_CHAR, 0, comm.get(), &request),
           "MPI_Igatherv");
  waitIdle(request, "the traces of all ranks");
  return all;
}

/// Collective. The earliest of all ranks' beginnings, by this rank's clock.
Clock::time_point earliest(const Communicator& comm, std::span<const TraceEvent> events,
                           std::chrono::nanoseconds ahead) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const TraceEvent& event : events)
    first =
        std::min(first, std::chrono::nanoseconds{event.begin.time_since_epoch() - ahead}.count());
  allReduce(comm, std::span{&first, 1}, MPI_MIN);
  return Clock::time_point{std::chrono::nanoseconds{first} + ahead};
}

}  // namespace

std::string traceEntries(int rank, std::span<const TraceEvent> events, Clock::time_point zero) {
  std::string text = fmt::format(
      R"({{"name":"thread_name","ph":"M","pid":0,"tid":{0},"args":{{"name":"rank {0}"}}}})", rank);
  for (const TraceEvent& event : events) {
    // Nanoseconds, so that what lies within another event still does.
    text += fmt::format(
        ",\n{{\"name\":\"{}\",\"ph\":\"X\",\"pid\":0,\"tid\":{},\"ts\":{:.3f},\"dur\":{:.3f}",
        event.name, rank, microseconds(event.begin - zero), microseconds(event.end - event.begin));
    if (event.number >= 0) text += fmt::format(R"(,"args":{{"number":{}}})", event.number);
    text += "}";
  }
  return text;
}

void writeTrace(const Communicator& comm, const TraceRecording& mine,
                const std::filesystem::path& target) {
  const ClockOffset offset = clockOffset(comm);
  const Clock::time_point zero = earliest(comm, mine.events(), offset.ahead);
  std::int64_t accuracy = offset.accuracy.count();
  allReduce(comm, std::span{&accuracy, 1}, MPI_MAX);
  const std::string entries =
      gatherTexts(comm, (comm.isRoot() ? "" : ",\n") +
                            traceEntries(static_cast<int>(comm.rank()), mine.events(), zero));
  onRoot(comm, [&] {
    writeTextFile(target,
                  fmt::format("{{\"displayTimeUnit\":\"ms\",\n\"otherData\":{{\"program\":"
                              "\"burin {}\",\"clock_accuracy_us\":{:.3f}}},\n"
                              "\"traceEvents\":[\n{}\n]}}\n",
                              programVersion(), static_cast<double>(accuracy) / 1000, entries));
  });
}

}  // namespace burin::host
