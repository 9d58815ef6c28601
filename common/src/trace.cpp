#include "burin/common/trace.hpp"

#include "burin/common/error.hpp"

namespace burin {

namespace {
thread_local TraceRecording* recording = nullptr;
}

TraceRecording::TraceRecording() {
  BURIN_CHECK(recording == nullptr);
  recording = this;
}

TraceRecording::~TraceRecording() {
  recording = nullptr;
}

bool isTracing() {
  return recording != nullptr;
}

void recordSpan(const TraceEvent& event) {
  if (recording != nullptr) recording->events_.push_back(event);
}

}  // namespace burin
