#pragma once

#include <chrono>
#include <optional>
#include <vector>

namespace burin {

/// Something that this process was busy with for a while.
struct TraceEvent {
  const char* name;  ///< of static storage: letters, digits, spaces
  int number;        ///< tells events of one name apart; -1 if there is nothing to tell
  std::chrono::steady_clock::time_point begin, end;
};

/// While one lives, the thread that made it records its spans; those of other threads, and spans
/// without a recording, cost a comparison. At most one per thread.
class TraceRecording {
 public:
  TraceRecording();
  ~TraceRecording();
  TraceRecording(const TraceRecording&) = delete;
  TraceRecording& operator=(const TraceRecording&) = delete;

  /// In the order of their ends, so that what lies within another event comes before it.
  const std::vector<TraceEvent>& events() const { return events_; }

 private:
  friend void recordSpan(const TraceEvent& event);
  std::vector<TraceEvent> events_;
};

/// Whether this thread records.
bool isTracing();
/// Adds to this thread's recording, if there is one.
void recordSpan(const TraceEvent& event);

/// Its scope is an event of the recording, if there is one.
class TraceSpan {
 public:
  explicit TraceSpan(const char* name, int number = -1) {
    if (isTracing()) event_.emplace(TraceEvent{name, number, std::chrono::steady_clock::now(), {}});
  }
  ~TraceSpan() {
    if (!event_) return;
    event_->end = std::chrono::steady_clock::now();
    recordSpan(*event_);
  }
  TraceSpan(const TraceSpan&) = delete;
  TraceSpan& operator=(const TraceSpan&) = delete;

 private:
  std::optional<TraceEvent> event_;
};

}  // namespace burin
