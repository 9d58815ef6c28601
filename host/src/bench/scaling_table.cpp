#include "bench/scaling_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace burin::host::bench {

namespace {

using Row = ScalingMeasurement;

constexpr int kBalancedRanks = 8;

const char* modeOf(const Row& row) {
  return row.isIsolated ? "isolated" : "wall";
}

std::vector<Row> isolatedOf(std::span<const Row> rows, std::string_view kind) {
  std::vector<Row> found;
  std::ranges::copy_if(rows, std::back_inserter(found),
                       [&](const Row& row) { return row.isIsolated && row.kind == kind; });
  std::ranges::sort(found, {}, &Row::ranks);
  return found;
}

bool has(std::span<const Row> rows, std::string_view kind, bool isIsolated) {
  return std::ranges::any_of(
      rows, [&](const Row& row) { return row.kind == kind && row.isIsolated == isIsolated; });
}

std::string gain(std::span<const Row> rows, std::string_view kind, bool isIdealFlat) {
  const auto curve = isolatedOf(rows, kind);
  if (curve.size() < 2 || curve.front().ranks != 1) return {};
  const Row& last = curve.back();
  const double ratio = curve.front().frameMs / last.frameMs;
  if (isIdealFlat)
    return fmt::format("  {} scaling, {} ranks: {:.3f} of one rank's time\n", kind, last.ranks,
                       1 / ratio);
  return fmt::format("  {} scaling, {} ranks: {:.2f} times as fast as one, {:.1f} % of the ideal\n",
                     kind, last.ranks, ratio, 100 * ratio / last.ranks);
}

std::string diagram(std::span<const Row> rows, std::string_view kind) {
  struct Line {
    const char* column;
    const char* title;
  };
  constexpr Line kLines[] = {{"frame_ms", "frame"},
                             {"render_max_ms", "slowest rank"},
                             {"render_mean_ms", "mean of the ranks"},
                             {"composite_ms", "composite"}};
  std::vector<std::string> curves;
  for (const bool isIsolated : {true, false}) {
    if (!has(rows, kind, isIsolated)) continue;
    int colour = 0;
    for (const auto& [column, title] : kLines) {
      curves.push_back(fmt::format(
          "t using (of('{}','{}') ? column('ranks') : NaN):(column('{}')) title '{}{}' {} lc {}",
          kind, isIsolated ? "isolated" : "wall", column, title, isIsolated ? "" : ", wall",
          isIsolated ? "@thick" : "@thin", ++colour));
    }
  }
  return fmt::format("set title '{} scaling'\nplot {}\n", kind, fmt::join(curves, ", \\\n  "));
}

}  // namespace

std::string scalingTableCsv(std::span<const Row> rows) {
  std::string text =
      "kind,mode,ranks,render_max_ms,render_mean_ms,composite_ms,frame_ms,imbalance,scene,width,"
      "height,dims_x,dims_y,dims_z,repeats\n";
  for (const Row& row : rows) {
    text += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{},{},{},{}\n",
                        row.kind, modeOf(row), row.ranks, row.renderMaxMs, row.renderMeanMs,
                        row.compositeMs, row.frameMs, row.imbalance(), row.scene, row.frame.width,
                        row.frame.height, row.dims.x, row.dims.y, row.dims.z, row.repeats);
  }
  return text;
}

std::string scalingLine(const Row& row) {
  return fmt::format(
      "{:<7} {:<9}{:<12}{:>4} ranks   render {:>9.3f} ms (mean {:>9.3f})   composite {:>7.3f}   "
      "frame {:>9.3f}\n",
      row.kind, modeOf(row), row.scene, row.ranks, row.renderMaxMs, row.renderMeanMs,
      row.compositeMs, row.frameMs);
}

std::string scalingSummary(std::span<const Row> rows) {
  std::string text;
  for (const Row& row : rows) {
    if (row.isIsolated && row.ranks == kBalancedRanks)
      text += fmt::format("  {} ranks, {} {}: slowest / mean {:.3f}\n", row.ranks, row.kind,
                          row.scene, row.imbalance());
  }
  return text + gain(rows, "strong", false) + gain(rows, "weak", true);
}

std::string scalingTablePlots(std::span<const Row> rows) {
  std::vector<std::string> diagrams;
  for (const char* kind : {"strong", "weak"}) {
    if (has(rows, kind, true) || has(rows, kind, false)) diagrams.push_back(diagram(rows, kind));
  }
  if (diagrams.empty()) return {};
  return fmt::format(R"(# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set grid
set key bottom left font ',8'
set terminal pngcairo size {},520 font ',10'
set output 'scaling.png'
set logscale x 2
set logscale y
set xlabel 'ranks'
set ylabel 'median ms'
t = 'scaling.csv'
of(kind, mode) = strcol('kind') eq kind && strcol('mode') eq mode
thick = "with linespoints lw 2"
thin = "with linespoints dashtype 2"
set multiplot layout 1,{}
{}unset multiplot
)",
                     620 * diagrams.size(), diagrams.size(), fmt::join(diagrams, ""));
}

}  // namespace burin::host::bench
