#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "burin/common/trace.hpp"

namespace burin {

/// The phases of a frame, in order. Names are those of the `--stats` contract.
enum class Phase { kUpdate, kDraw, kComposite, kGather, kFinish, kWrite, kCount };
const char* phaseName(Phase phase);

struct PhaseTimes {
  double ms[static_cast<int>(Phase::kCount)] = {};
  double& operator[](Phase phase) { return ms[static_cast<int>(phase)]; }
  double operator[](Phase phase) const { return ms[static_cast<int>(phase)]; }
};

/// What one rank did in one frame. Trivially copyable: ranks send it as bytes.
struct RankStatistics {
  std::int32_t rank = 0;
  std::int32_t bricks = 0;
  PhaseTimes phases;
  std::int64_t samplesVisited = 0;          ///< volume fetched at a lattice point; 0 if not counted
  std::int64_t samplesShaded = 0;           ///< extinction > 0
  std::int64_t samplesInOccupiedCells = 0;  ///< visited, and placed in a cell that may be visible
  std::int64_t leaps = 0;
  std::int64_t bytesSent = 0;
  std::int64_t bytesReceived = 0;
  std::int64_t messagesSent = 0;
  std::int64_t bytesToRoot = 0;       ///< of bytesSent, finished pixels for the gather
  std::int64_t bytesByReference = 0;  ///< of bytesSent, pixels the receiver read in shared memory
  std::int64_t bytesPackedAway = 0;   ///< what zstd saved; not in bytesSent
  std::int64_t activePixels = 0;
  std::int64_t residentVoxelBytes = 0;
  std::int64_t peakRssBytes = 0;
};

/// How a frame's subimages were merged: what was asked for or chosen.
struct CompositeStatistics {
  std::string schedule;  ///< "swap", "radix-k", "direct", "serial"; "" if nothing was merged
  std::string wire;      ///< "float" or "half"
  int participants = 0;  ///< ranks with pixels where others have some
  int hosts = 1;
  bool isPacked = false;  ///< pixels that left a host went through zstd
};

struct FrameStatistics {
  double frameMs = 0;  ///< from "camera known" to "finished image in rank 0's memory"
  PhaseTimes phases;   ///< rank 0's view: what the user waits for
  /// Nothing had changed since the frame before, whose picture this is: nothing was drawn or
  /// merged.
  bool isUnchanged = false;
  CompositeStatistics composite;
  std::vector<RankStatistics> ranks;
};

struct RunStatistics {
  int ranks = 1;
  bool samplesCounted = false;
  std::vector<FrameStatistics> frames;
};

/// The `--stats` document. Sample counters are absent when they were not counted.
std::string statisticsJson(const RunStatistics& run);

/// Largest resident set this process has had so far, from the kernel.
std::int64_t peakResidentBytes();

/// Adds the time of its scope to a number of milliseconds, and to the recorded trace.
class PhaseTimer {
 public:
  /// `name`: in the trace; nullptr: not in it.
  explicit PhaseTimer(double& ms, const char* name = nullptr)
      : ms_{ms}, name_{name}, start_{std::chrono::steady_clock::now()} {}
  PhaseTimer(PhaseTimes& times, Phase phase) : PhaseTimer{times[phase], phaseName(phase)} {}
  ~PhaseTimer() {
    const auto end = std::chrono::steady_clock::now();
    ms_ += std::chrono::duration<double, std::milli>(end - start_).count();
    if (name_ != nullptr) recordSpan({name_, -1, start_, end});
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  double& ms_;
  const char* name_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace burin
