#include "bench/compositing_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace burin::host::bench {

namespace {

using Row = CompositingMeasurement;
constexpr std::string_view kMedian = "column('median_ms')";
using PeerAndSchedule = std::pair<std::string, std::string>;

/// Distinct values of `part`, in the order in which they come up.
template <typename Part>
auto distinct(std::span<const Row> rows, Part&& part) {
  std::vector<decltype(part(rows.front()))> values;
  for (const Row& row : rows) {
    auto value = part(row);
    if (std::ranges::find(values, value) == values.end()) values.push_back(std::move(value));
  }
  return values;
}

std::vector<PeerAndSchedule> linesOf(std::span<const Row> rows) {
  return distinct(rows, [](const Row& row) { return PeerAndSchedule{row.peer, row.schedule}; });
}

int mostRanks(std::span<const Row> rows) {
  return std::ranges::max(rows, {}, &Row::ranks).ranks;
}

/// A frame in the middle of those measured: 1024² of 512², 1024², 2048².
int middleWidth(std::span<const Row> rows) {
  auto widths = distinct(rows, [](const Row& row) { return row.frame.width; });
  std::ranges::sort(widths);
  return widths[widths.size() / 2];
}

/// One line of a diagram: `y` over `x` of the rows of one schedule that pass `filter`; all three in
/// gnuplot's language.
std::string curve(const PeerAndSchedule& line, std::string_view filter, std::string_view x,
                  std::string_view y, std::size_t style) {
  const auto& [peer, schedule] = line;
  return fmt::format("t using (of('{0}','{1}') && {2} ? {3} : NaN):({4}) title '{0} {1}' {5} {6}",
                     peer, schedule, filter, x, y, peer == "burin" ? "@thick" : "@thin",
                     fmt::format("lc {0} pt {0}", style));
}

/// What the model predicts for one schedule, in the colour of what was measured.
std::string modelledCurve(const PeerAndSchedule& line, std::string_view filter, std::string_view x,
                          std::size_t style) {
  const auto& [peer, schedule] = line;
  return fmt::format(
      "t using (of('{0}','{1}') && {2} ? {3} : NaN):(column('modelled_ms')) title '{0} {1}, "
      "modelled' with lines lc {4} dt 3 lw 1.5",
      peer, schedule, filter, x, style);
}

std::string diagram(std::span<const Row> rows, std::string_view title, std::string_view filter,
                    std::string_view x, std::string_view y) {
  std::vector<std::string> curves;
  std::size_t style = 0;
  for (const PeerAndSchedule& line : linesOf(rows)) {
    curves.push_back(curve(line, filter, x, y, ++style));
    if (y == kMedian && line.first == "burin")
      curves.push_back(modelledCurve(line, filter, x, style));
  }
  return fmt::format("set title '{}'\nplot {}\n", title, fmt::join(curves, ", \\\n  "));
}

/// A picture of diagrams side by side.
std::string picture(std::string_view file, std::string_view settings,
                    const std::vector<std::string>& diagrams) {
  return fmt::format(
      "\nset terminal pngcairo size {},520 font ',10'\nset output '{}'\nunset logscale\nset xtics "
      "autofreq\n{}"
      "set multiplot layout 1,{}\n{}unset multiplot\n",
      620 * diagrams.size(), file, settings, diagrams.size(), fmt::join(diagrams, ""));
}

constexpr std::string_view kPreamble = R"(# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set grid
set key top left font ',8'
t = 'compositing.csv'
of(peer, schedule) = strcol('peer') eq peer && strcol('schedule') eq schedule
thick = "with linespoints lw 2.5"
thin = "with linespoints dashtype 2"
)";

/// One diagram per input, over rank counts.
std::string rankPicture(std::span<const Row> rows, std::span<const std::string> inputs,
                        std::string_view file, std::string_view label, std::string_view y) {
  const int width = middleWidth(rows);
  std::vector<std::string> diagrams;
  for (const std::string& input : inputs) {
    diagrams.push_back(
        diagram(rows, fmt::format("{}, {} pixels wide", input, width),
                fmt::format("strcol('case') eq '{}' && column('width') == {}", input, width),
                "column('ranks')", y));
  }
  return picture(
      file,
      fmt::format("set xtics 1\nset xlabel 'ranks'\nset ylabel '{}'\nset yrange [0:*]\n", label),
      diagrams);
}

std::string sizePicture(std::span<const Row> rows, std::span<const std::string> inputs) {
  const int ranks = mostRanks(rows);
  std::vector<std::string> diagrams;
  for (const std::string& input : inputs) {
    diagrams.push_back(
        diagram(rows, fmt::format("{}, {} ranks", input, ranks),
                fmt::format("strcol('case') eq '{}' && column('ranks') == {}", input, ranks),
                "column('width')", kMedian));
  }
  return picture("compositing_size.png",
                 "set xlabel 'frame width, pixels'\nset ylabel 'median ms'\nset yrange [*:*]\n"
                 "set logscale xy 2\n",
                 diagrams);
}

std::string activePicture(std::span<const Row> rows) {
  return picture("compositing_active.png",
                 "set xlabel 'active fraction'\nset ylabel 'median ms'\nset yrange [*:*]\n"
                 "set logscale xy\n",
                 {diagram(rows, "a disc on every rank", "strcol('case') eq 'disc'",
                          "column('active_fraction')", kMedian)});
}

}  // namespace

std::string compositingPlots(std::span<const Row> rows) {
  auto inputs = distinct(rows, [](const Row& row) { return row.input; });
  const bool hasDiscs = std::erase(inputs, "disc") > 0;
  std::string text{kPreamble};
  text += rankPicture(rows, inputs, "compositing_time.png", "median ms", kMedian);
  text += rankPicture(rows, inputs, "compositing_bytes.png",
                      "MB sent by all ranks, with the collect", "column('bytes_total')/1e6");
  if (distinct(rows, [](const Row& row) { return row.frame.width; }).size() > 1)
    text += sizePicture(rows, inputs);
  if (hasDiscs) text += activePicture(rows);
  return text;
}

}  // namespace burin::host::bench
