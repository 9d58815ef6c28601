#include "bench/rate_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "bench/target_line.hpp"

namespace burin::host::bench {

namespace {

using Row = RateMeasurement;

struct LookTargets {
  Look look;
  double leastRatio;     ///< of rates
  double mostPerShaded;  ///< samples visited
};
constexpr LookTargets kTargets[] = {{Look::kOpaque, 0.25, 3.5}, {Look::kTranslucent, 0.7, 1.7}};
constexpr double kMostPerOccupied = 1.05;
constexpr std::size_t kWaysOfEachScene = 4;  // rows that follow one another

double quotient(std::int64_t above, std::int64_t below) {
  return static_cast<double>(above) / static_cast<double>(std::max<std::int64_t>(1, below));
}
double perShaded(const Row& row) {
  return quotient(row.frame.samplesVisited, row.frame.samplesShaded);
}
double perOccupied(const Row& row) {
  return quotient(row.frame.samplesVisited, row.frame.samplesInOccupiedCells);
}

/// The values of a look's rows whose frames show something.
std::vector<double> valuesOf(std::span<const Row> rows, Look look, double (*value)(const Row&)) {
  std::vector<double> values;
  for (const Row& row : rows)
    if (row.look == look && row.frame.samplesShaded > 0) values.push_back(value(row));
  return values;
}

std::optional<double> largest(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::ranges::max(values);
}
std::optional<double> smallest(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::ranges::min(values);
}

/// Points by scene of one look and shading.
std::string points(Look look, Shading shading, int colour, int symbol) {
  return fmt::format(
      "t using (of('{0}','{1}') ? floor(column(0)/{4}) : NaN):(@what) "
      "with points lc {2} pt {3} ps 1.4 title '{0}, {1}'",
      name(look), name(shading), colour, symbol, kWaysOfEachScene);
}

std::string diagram(std::string_view label, std::string_view value,
                    double (*target)(const LookTargets&)) {
  std::vector<std::string> curves;
  int colour = 1;
  for (const LookTargets& targets : kTargets) {
    curves.push_back(points(targets.look, Shading::kPlain, colour, 6));
    curves.push_back(points(targets.look, Shading::kToneEdges, colour, 7));
    curves.push_back(fmt::format("{} lc {} dt 2 title 'target, {}'", target(targets), colour,
                                 name(targets.look)));
    ++colour;
  }
  return fmt::format("set ylabel '{}'\nwhat = \"{}\"\nplot {}\n", label, value,
                     fmt::join(curves, ", \\\n  "));
}

/// The scenes' names at the places of their rows.
std::string ticks(std::span<const Row> rows) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rows.size(); i += kWaysOfEachScene)
    names.push_back(fmt::format("'{}' {}", rows[i].scene, names.size()));
  return fmt::format("set xtics ({}) rotate by -45 noenhanced\nset xrange [-0.5:{}]\n",
                     fmt::join(names, ", "), static_cast<double>(names.size()) - 0.5);
}

}  // namespace

std::string rateCsv(std::span<const Row> rows) {
  std::string text =
      "scene,look,style,ratio,median_ms,samples_visited,samples_shaded,samples_in_occupied_cells,"
      "leaps,samples_per_second,smallest_ms,largest_ms,busy_median_ms,busy_samples_visited,"
      "busy_samples_shaded,busy_pixels,busy_samples_per_second,busy_smallest_ms,busy_largest_ms,"
      "repeats\n";
  for (const Row& row : rows) {
    const FrameRate& frame = row.frame;
    const FrameRate& busy = row.busy;
    text += fmt::format("{},{},{},{:.5f},{:.4f},{},{},{},{},{:.5g},{:.4f},{:.4f},", row.scene,
                        name(row.look), name(row.shading), row.ratio, frame.medianMs,
                        frame.samplesVisited, frame.samplesShaded, frame.samplesInOccupiedCells,
                        frame.leaps, frame.samplesPerSecond(), frame.smallestMs, frame.largestMs);
    text += fmt::format("{:.4f},{},{},{},{:.5g},{:.4f},{:.4f},{}\n", busy.medianMs,
                        busy.samplesVisited, busy.samplesShaded, busy.pixels,
                        busy.samplesPerSecond(), busy.smallestMs, busy.largestMs, row.repeats);
  }
  return text;
}

std::string rateLine(const Row& row) {
  return fmt::format(
      "{:<16} {:<11} {:<10} {:>7.1f} M samples/s of {:>7.1f}: {:.3f}   visited / in occupied cells "
      "{:.3f}, / shaded {:.3f}\n",
      row.scene, name(row.look), name(row.shading), 1e-6 * row.frame.samplesPerSecond(),
      1e-6 * row.busy.samplesPerSecond(), row.ratio, perOccupied(row), perShaded(row));
}

std::string rateTargets(std::span<const Row> rows) {
  std::string text;
  for (const LookTargets& targets : kTargets) {
    const auto values = [&](double (*value)(const Row&)) {
      return valuesOf(rows, targets.look, value);
    };
    const char* look = name(targets.look);
    text +=
        atLeastLine(fmt::format("{}: rate of samples / all lanes busy, worst", look),
                    smallest(values([](const Row& row) { return row.ratio; })), targets.leastRatio);
    text += atMostLine(fmt::format("{}: samples visited / in occupied cells, worst", look),
                       largest(values(perOccupied)), kMostPerOccupied);
    text += atMostLine(fmt::format("{}: samples visited / shaded, worst", look),
                       largest(values(perShaded)), targets.mostPerShaded);
  }
  return text;
}

std::string ratePlots(std::span<const Row> rows) {
  std::string text = R"(# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set grid
set key bottom right font ',8'
set terminal pngcairo size 1240,520 font ',10'
set output 'rates.png'
set yrange [0:*]
t = 'rates.csv'
of(look, style) = strcol('look') eq look && strcol('style') eq style
set multiplot layout 1,2
)";
  text += ticks(rows);
  text += diagram("samples per second / all lanes busy", "column('ratio')",
                  [](const LookTargets& targets) { return targets.leastRatio; });
  text += diagram("samples visited / shaded", "column('samples_visited')/column('samples_shaded')",
                  [](const LookTargets& targets) { return targets.mostPerShaded; });
  return text + "unset multiplot\n";
}

}  // namespace burin::host::bench
