#include "bench/skip_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/target_line.hpp"

namespace burin::host::bench {

namespace {

using Row = SkipMeasurement;

/// The scene for the target: 1 % of the voxels, give or take their rounding.
constexpr double kTargetFraction = 0.01;
constexpr double kFractionTolerance = 0.1;  // relative

std::optional<double> onePercentToDense(std::span<const Row> rows, std::string_view scene) {
  for (const Row& row : rows) {
    const bool isOnePercent =
        std::abs(row.visibleFraction - kTargetFraction) <= kFractionTolerance * kTargetFraction;
    if (row.scene == scene && row.isSkipping && isOnePercent && row.ratioToDense > 0)
      return row.ratioToDense;
  }
  return std::nullopt;
}

/// Of the scene where it is largest, among those with skipping.
std::optional<double> worstRatio(std::span<const Row> rows, std::int64_t Row::*above,
                                 std::int64_t Row::*below) {
  std::optional<double> worst;
  for (const Row& row : rows) {
    if (!row.isSkipping || row.*below == 0) continue;
    const double ratio = static_cast<double>(row.*above) / static_cast<double>(row.*below);
    worst = std::max(worst.value_or(ratio), ratio);
  }
  return worst;
}

double perShaded(const Row& row) {
  return static_cast<double>(row.samplesVisited) /
         static_cast<double>(std::max<std::int64_t>(1, row.samplesShaded));
}

std::vector<std::string> scenesOf(std::span<const Row> rows) {
  std::vector<std::string> scenes;
  for (const Row& row : rows) {
    if (std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
  }
  return scenes;
}

std::string diagram(std::span<const std::string> scenes, std::string_view label,
                    std::string_view column) {
  std::vector<std::string> curves;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const bool isSkipping : {true, false}) {
      curves.push_back(fmt::format(
          "t using (of('{0}','{1}') ? column('visible_fraction') : "
          "NaN):(column('{2}')) title '{0}, skip {1}' {3} lc {4} pt {4}",
          scenes[i], isSkipping ? "on" : "off", column, isSkipping ? "@thick" : "@thin", i + 1));
    }
  }
  return fmt::format("set ylabel '{}'\nplot {}\n", label, fmt::join(curves, ", \\\n  "));
}

}  // namespace

std::string skipCsv(std::span<const Row> rows) {
  std::string text =
      "scene,visible_fraction,skip,median_ms,samples_visited,samples_shaded,"
      "samples_in_occupied_cells,leaps,ratio_to_dense,smallest_ms,largest_ms,edit_ms,repeats\n";
  for (const Row& row : rows) {
    const std::string ratio =
        row.ratioToDense > 0 ? fmt::format("{:.5f}", row.ratioToDense) : std::string{};
    const std::string edit = row.editMs >= 0 ? fmt::format("{:.4f}", row.editMs) : std::string{};
    text += fmt::format("{},{:.6g},{},{:.4f},{},{},{},{},{},{:.4f},{:.4f},{},{}\n", row.scene,
                        row.visibleFraction, row.isSkipping ? "on" : "off", row.medianMs,
                        row.samplesVisited, row.samplesShaded, row.samplesInOccupiedCells,
                        row.leaps, ratio, row.smallestMs, row.largestMs, edit, row.repeats);
  }
  return text;
}

std::string skipLine(const Row& on, const Row& off) {
  std::string text = fmt::format("{:<12}{:>8.3f} % visible   on {:>9.3f} ms   off {:>9.3f} ms",
                                 on.scene, 100 * on.visibleFraction, on.medianMs, off.medianMs);
  if (on.ratioToDense > 0) text += fmt::format("   on / dense {:.4f}", on.ratioToDense);
  if (on.editMs >= 0) text += fmt::format("   edit {:.1f} ms", on.editMs);
  return text + fmt::format("   visited / shaded {:.3f}\n", perShaded(on));
}

std::string skipTargets(std::span<const Row> rows) {
  std::string text = atMostLine("one ball of 1 % of the voxels / dense, time",
                                onePercentToDense(rows, kBall), 0.08);
  text += atMostLine(fmt::format("{} balls of 1 % together / dense, time", kManyBalls),
                     onePercentToDense(rows, kBalls), 0.12);
  text += atMostLine("samples visited / in occupied cells, worst scene",
                     worstRatio(rows, &Row::samplesVisited, &Row::samplesInOccupiedCells), 1.05);
  if (const auto worst = worstRatio(rows, &Row::samplesVisited, &Row::samplesShaded))
    text += fmt::format("  {:<52}{:>8.4f}\n", "samples visited / shaded, worst scene", *worst);
  double edit = -1;
  for (const Row& row : rows) edit = std::max(edit, row.editMs);
  if (edit >= 0)
    text += atMostLine("a transfer-function edit beyond its frame, worst, ms", edit, 50);
  return text.empty() ? text : "with skipping\n" + text;
}

std::string skipPlots(std::span<const Row> rows) {
  std::string text = R"(# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set grid
set key bottom right font ',8'
set terminal pngcairo size 1240,520 font ',10'
set output 'skip.png'
set logscale xy
set xlabel 'visible fraction of the voxels'
t = 'skip.csv'
of(scene, skip) = strcol('scene') eq scene && strcol('skip') eq skip
thick = "with linespoints lw 2.5"
thin = "with linespoints dashtype 2"
set multiplot layout 1,2
)";
  const auto scenes = scenesOf(rows);
  text += diagram(scenes, "median ms", "median_ms");
  text += diagram(scenes, "samples visited", "samples_visited");
  return text + "unset multiplot\n";
}

}  // namespace burin::host::bench
