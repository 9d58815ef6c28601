#include "burin/common/statistics.hpp"

#include <sys/resource.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "burin/common/error.hpp"

namespace burin {

namespace {

static_assert(std::is_trivially_copyable_v<RankStatistics>);

using Json = nlohmann::ordered_json;

constexpr int kPhases = static_cast<int>(Phase::kCount);

Json phasesJson(const PhaseTimes& phases) {
  Json json = Json::object();
  for (int i = 0; i < kPhases; ++i) {
    const Phase phase{i};
    json[phaseName(phase)] = phases[phase];
  }
  return json;
}

Json rankJson(const RankStatistics& rank, bool samplesCounted) {
  Json json;
  json["rank"] = rank.rank;
  json["bricks"] = rank.bricks;
  json["phases_ms"] = phasesJson(rank.phases);
  if (samplesCounted) {
    json["samples_visited"] = rank.samplesVisited;
    json["samples_shaded"] = rank.samplesShaded;
    json["samples_in_occupied_cells"] = rank.samplesInOccupiedCells;
    json["leaps"] = rank.leaps;
  }
  json["bytes_sent"] = rank.bytesSent;
  json["bytes_received"] = rank.bytesReceived;
  json["messages_sent"] = rank.messagesSent;
  json["bytes_to_root"] = rank.bytesToRoot;
  json["bytes_by_reference"] = rank.bytesByReference;
  json["bytes_packed_away"] = rank.bytesPackedAway;
  json["active_pixels"] = rank.activePixels;
  json["resident_voxel_bytes"] = rank.residentVoxelBytes;
  json["peak_rss_bytes"] = rank.peakRssBytes;
  return json;
}

Json compositeJson(const CompositeStatistics& composite) {
  Json json;
  json["schedule"] = composite.schedule;
  json["wire"] = composite.wire;
  json["participants"] = composite.participants;
  json["hosts"] = composite.hosts;
  json["packed"] = composite.isPacked;
  return json;
}

Json frameJson(const FrameStatistics& frame, bool samplesCounted) {
  Json json;
  json["frame_ms"] = frame.frameMs;
  json["phases_ms"] = phasesJson(frame.phases);
  if (frame.isUnchanged) json["unchanged"] = true;
  if (!frame.composite.schedule.empty()) json["composite"] = compositeJson(frame.composite);
  json["ranks"] = Json::array();
  for (const RankStatistics& rank : frame.ranks) {
    json["ranks"].push_back(rankJson(rank, samplesCounted));
  }
  return json;
}

}  // namespace

const char* phaseName(Phase phase) {
  static constexpr const char* kNames[kPhases] = {"update", "draw",   "composite",
                                                  "gather", "finish", "write"};
  BURIN_CHECK(phase >= Phase::kUpdate && phase < Phase::kCount);
  return kNames[static_cast<int>(phase)];
}

std::string statisticsJson(const RunStatistics& run) {
  Json json;
  json["ranks"] = run.ranks;
  json["frames"] = Json::array();
  for (const FrameStatistics& frame : run.frames) {
    json["frames"].push_back(frameJson(frame, run.samplesCounted));
  }
  return json.dump(2) + "\n";
}

std::int64_t peakResidentBytes() {
  // VmHWM rather than getrusage: ru_maxrss starts at what the launcher had resident when it forked.
  std::ifstream status{"/proc/self/status"};
  for (std::string word; status >> word;) {
    std::int64_t kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace burin
