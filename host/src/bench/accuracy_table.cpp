#include "bench/accuracy_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "burin/common/combine_name.hpp"
#include "burin/common/palette_names.hpp"

namespace burin::host::bench {

namespace {

using Row = AccuracyMeasurement;

std::string orZero(const std::optional<double>& value) {
  return fmt::format("{:g}", value.value_or(0));
}

std::vector<std::string> scenesOf(std::span<const Row> rows) {
  std::vector<std::string> scenes;
  for (const Row& row : rows)
    if (std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
  return scenes;
}

bool isSliced(const Row& row) {
  return row.technique == node::Technique::kSlices;
}

/// What of hardware with palettes is in a row.
std::string paletteWay(const Row& row) {
  std::string text;
  if (row.normals == Normals::kQuantised) text += ", 240 normals";
  if (row.palettes == Palettes::kBefore) text += ", palettes first";
  return text + (row.preintegrated ? "" : ", midpoint");
}

std::string wayOf(const Row& row) {
  if (isSliced(row))
    return fmt::format("slices, {}, {}{}, step {:g}", name(row.precision), name(row.combine),
                       paletteWay(row), *row.stepVoxels);
  const std::string how = row.preintegrated ? "pre-integrated" : "midpoint";
  if (row.maxErrorAsked) return fmt::format("{}, max_error 1/{:.0f}", how, 1 / *row.maxErrorAsked);
  return fmt::format("{}, step {:g}", how, *row.stepVoxels);
}

/// Fewest samples of a fixed step of that kind whose error is no larger; 0 if there is none.
std::int64_t cheapestFixed(const Row& row, std::span<const Row> rows) {
  std::int64_t fewest = 0;
  for (const Row& other : rows) {
    if (other.scene != row.scene || isSliced(other) || !other.stepVoxels ||
        other.preintegrated != row.preintegrated || other.error.largest > row.error.largest)
      continue;
    if (fewest == 0 || other.samplesVisited < fewest) fewest = other.samplesVisited;
  }
  return fewest;
}

/// One line or cloud of a diagram: error over `x` of the rows that pass `filter`.
std::string curve(std::string_view filter, std::string_view x, std::string_view with,
                  std::string_view title) {
  return fmt::format("t using ({} ? column('{}') : NaN):(column('error_max')) with {} title '{}'",
                     filter, x, with, title);
}

std::string diagram(std::string_view scene, bool severalPasses, std::string_view x,
                    std::string_view label) {
  const std::string here = fmt::format("strcol('scene') eq '{}'", scene);
  std::vector<std::string> curves;
  for (const bool preintegrated : {true, false}) {
    const std::string kind =
        fmt::format("{} && strcol('technique') eq 'raycast' && column('preintegrated') == {}", here,
                    preintegrated ? 1 : 0);
    const std::string name = preintegrated ? "pre-integrated" : "midpoint";
    const int colour = preintegrated ? 1 : 2;
    curves.push_back(curve(kind + " && column('max_error_asked') == 0", x,
                           fmt::format("linespoints lc {} pt 4", colour), name));
    curves.push_back(curve(kind + " && column('max_error_asked') > 0", x,
                           fmt::format("points lc {} pt 7", colour), name + ", max\\_error"));
  }
  const auto slices = [&](std::string_view precision, std::string_view combine, int colour) {
    curves.push_back(
        curve(fmt::format("{} && strcol('technique') eq 'slices' && strcol('precision') eq '{}' && "
                          "strcol('combine') eq '{}' && column('preintegrated') == 1",
                          here, precision, combine),
              x, fmt::format("linespoints lc {} pt 8 dt 2", colour),
              combine == "over" ? fmt::format("slices, {}, over", precision)
                                : fmt::format("slices, {}", precision)));
  };
  slices("float", "sum", 3);
  slices("half", "sum", 4);
  slices("byte", "sum", 5);
  if (severalPasses) slices("float", "over", 6);
  if (severalPasses) slices("byte", "over", 7);
  curves.push_back(curve(here + " && column('pareto') == 1", x, "points pt 6 ps 2.2 lc 8",
                         "Pareto front (time)"));
  return fmt::format("set title '{}'\nset xlabel '{}'\nplot {}\n", scene, label,
                     fmt::join(curves, ", \\\n  "));
}

}  // namespace

bool isOnFront(const Row& row, std::span<const Row> rows) {
  return std::ranges::none_of(rows, [&](const Row& other) {
    return other.scene == row.scene && other.medianMs < row.medianMs &&
           other.error.largest <= row.error.largest;
  });
}

std::string accuracyCsv(std::span<const Row> rows) {
  std::string text =
      "volume,scene,technique,precision,preintegrated,step_voxels,max_error_asked,median_ms,"
      "samples_visited,error_max,error_rms,error_delta_e,reference_change,pareto,combine,normals,"
      "palettes\n";
  for (const Row& row : rows)
    text += fmt::format(
        "{0},{0},{11},{12},{1},{2},{3},{4:.4g},{5},{6:.4g},{7:.4g},{8:.4g},"
        "{9:.3g},{10},{13},{14},{15}\n",
        row.scene, row.preintegrated ? 1 : 0, orZero(row.stepVoxels), orZero(row.maxErrorAsked),
        row.medianMs, row.samplesVisited, row.error.largest, row.error.rms, row.error.deltaE,
        row.referenceChange, isOnFront(row, rows) ? 1 : 0, name(row.technique), name(row.precision),
        name(row.combine), name(row.normals), name(row.palettes));
  return text;
}

std::string accuracySummary(std::span<const Row> rows) {
  std::string text;
  for (const std::string& scene : scenesOf(rows)) {
    const auto first = std::ranges::find(rows, scene, &Row::scene);
    text += fmt::format("{}: the reference changes by {:.2g} when it is asked for twice as much\n",
                        scene, first->referenceChange);
    text += fmt::format("  {:60} {:>10} {:>12} {:>9} {:>9} {:>8}\n", "", "median ms", "samples",
                        "max", "rms", "delta E");
    for (const Row& row : rows) {
      if (row.scene != scene) continue;
      text += fmt::format("{} {:60} {:10.2f} {:12} {:9.2g} {:9.2g} {:8.2f}",
                          isOnFront(row, rows) ? " *" : "  ", wayOf(row), row.medianMs,
                          row.samplesVisited, row.error.largest, row.error.rms, row.error.deltaE);
      if (row.maxErrorAsked) {
        const std::int64_t fixed = cheapestFixed(row, rows);
        text += row.error.largest <= *row.maxErrorAsked ? "  kept" : "  NOT KEPT";
        if (fixed > 0)
          text += fmt::format(", {:.2f} of the samples of a fixed step that reaches as much",
                              static_cast<double>(row.samplesVisited) / static_cast<double>(fixed));
      }
      text += "\n";
    }
  }
  return text + "* nothing else is both faster and as accurate\n";
}

std::string accuracyPlots(std::span<const Row> rows) {
  const auto scenes = scenesOf(rows);
  std::string text = fmt::format(
      "# gnuplot script; run it in this folder\nset datafile separator ','\n"
      "set datafile columnheaders\nset datafile missing NaN\nset grid\nset key bottom left font "
      "',8'\nt = 'accuracy.csv'\nset terminal pngcairo size {},960 font ',10'\n"
      "set output 'accuracy.png'\nset logscale xy\nset ylabel 'largest error'\nset format y "
      "'%.0e'\nset multiplot layout 2,{}\n",
      620 * scenes.size(), scenes.size());
  const auto severalPasses = [&](const std::string& scene) {
    return std::ranges::any_of(
        rows, [&](const Row& row) { return row.scene == scene && row.combine == Combine::kOver; });
  };
  for (const std::string& scene : scenes)
    text += diagram(scene, severalPasses(scene), "median_ms", "median ms");
  for (const std::string& scene : scenes)
    text += diagram(scene, severalPasses(scene), "samples_visited", "samples");
  return text + "unset multiplot\n";
}

}  // namespace burin::host::bench
