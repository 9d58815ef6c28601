#include "bench/scaling_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include "burin/compositor/cost_model.hpp"
#include "burin/compositor/frame_notice.hpp"

namespace burin::host::bench {

namespace {

using namespace compositor;

constexpr int kMostRanks = 65536;
constexpr double kFramePixels = 1024.0 * 1024.0;
constexpr double kCovered = 0.2;

constexpr std::array kModelledSchedules{
    std::pair{std::string_view{"swap"}, ScheduleKind::kBinarySwap},
    std::pair{std::string_view{"radix-k"}, ScheduleKind::kRadixK},
    std::pair{std::string_view{"direct"}, ScheduleKind::kDirectSend}};

/// Everybody sends a notice to everybody; beyond kMostRanksWithCoverage the coverages are summed
/// along a tree besides. The agreement is a tree up and down.
double collectiveSeconds(int ranks, const LogGP& link) {
  const double hop = link.latency + 2.0 * link.overhead;
  const double perNotice = std::max(
      {2.0 * link.overhead, link.gap, static_cast<double>(noticeBytes(ranks)) * link.gapPerByte});
  const double rounds = 2.0 * std::bit_width(static_cast<unsigned>(ranks - 1));
  double seconds = link.latency + (ranks - 1) * perNotice + rounds * hop;
  if (ranks > kMostRanksWithCoverage) {
    const double bytes = 8.0 * static_cast<double>(Coverage::kCells);
    seconds += rounds * (hop + bytes * link.gapPerByte);
  }
  return seconds;
}

double frameMs(int ranks, ScheduleKind kind, bool isDense, const ReplayMachine& replay) {
  const ScheduleOptions options{kind};
  const int pieces = pieceCount(options, ranks);
  const Region all{0, static_cast<std::size_t>(pieces)};  // a piece is a position
  const Workload workload = isDense ? denseWorkload(ranks, all, kFramePixels)
                                    : volumeWorkload(ranks, all, kCovered * kFramePixels);
  const WorkRates& work = replay.work;
  const Machine machine{
      replay.link, {work.perCombinedPixel, 0.5 * (work.perEncodedByte + work.perDecodedByte)}, 0};
  const LazySchedule schedule = lazySchedule(options, ranks, evenCuts(all.end, pieces));
  const double seconds =
      predictAlike(schedule, activePixels(workload), WireSize{}, machine).seconds();
  return 1e3 * (seconds + collectiveSeconds(ranks, replay.link));
}

}  // namespace

std::string scalingCsv(const FrameModel& model) {
  std::string text = "kind,schedule,ranks,modelled_ms\n";
  for (const bool isDense : {true, false}) {
    for (const auto& [name, kind] : kModelledSchedules) {
      for (int ranks = 2; ranks <= kMostRanks; ranks *= 2) {
        text += fmt::format("{},{},{},{:.4f}\n", isDense ? "dense" : "sparse", name, ranks,
                            frameMs(ranks, kind, isDense, model.machine));
      }
    }
  }
  return text;
}

std::string scalingPlot() {
  std::string text = R"(# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set grid
set key top left
set terminal pngcairo size 1240,520 font ',10'
set output 'model_scaling.png'
set logscale xy
set xtics 4
set xlabel 'ranks'
set ylabel 'modelled ms, 1024x1024'
t = 'model_scaling.csv'
set multiplot layout 1,2
)";
  for (const std::string_view kind : {"dense", "sparse"}) {
    text += fmt::format("set title '{}'\nplot ", kind);
    for (const auto& [name, unused] : kModelledSchedules) {
      text += fmt::format(
          "t using (strcol('kind') eq '{0}' && strcol('schedule') eq '{1}' ? column('ranks') : "
          "NaN):'modelled_ms' title '{1}' with linespoints, ",
          kind, name);
    }
    text.resize(text.size() - 2);
    text += '\n';
  }
  return text + "unset multiplot\n";
}

}  // namespace burin::host::bench
