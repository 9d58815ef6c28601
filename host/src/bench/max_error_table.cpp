#include "bench/max_error_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace burin::host::bench {

namespace {

using Row = MaxErrorMeasurement;

/// All samples of the picture over those of the fixed step, if there is one.
std::optional<double> ratio(const Row& row, const std::optional<FixedStep>& fixed) {
  if (!fixed || fixed->samples == 0) return {};
  return static_cast<double>(row.samples) / static_cast<double>(fixed->samples);
}

std::string ratioText(const Row& row, const std::optional<FixedStep>& fixed) {
  const auto value = ratio(row, fixed);
  return value ? fmt::format("{:.2f}", *value) : "-";
}

}  // namespace

std::string maxErrorCsv(std::span<const Row> rows) {
  std::string text =
      "volume,function,azimuth_deg,elevation_deg,max_error_asked,error_max,samples_visited,"
      "as_good_step,as_good_samples,as_asked_step,as_asked_samples,"
      "truth_change\n";
  for (const Row& row : rows) {
    const FixedStep good = row.asGood.value_or(FixedStep{});
    const FixedStep asked = row.asAsked.value_or(FixedStep{});
    text += fmt::format("{},{},{:g},{:g},{:g},{:.4g},{},{:g},{},{:g},{},{:.2g}\n", row.volume,
                        row.function, row.azimuthDeg, row.elevationDeg, row.asked, row.errorMax,
                        row.samples, good.stepVoxels, good.samples, asked.stepVoxels, asked.samples,
                        row.truthChange);
  }
  return text;
}

std::string maxErrorSummary(std::span<const Row> rows) {
  std::string text =
      fmt::format("{:28} {:8} {:>10} {:>8} {:>10} {:>22} {:>12}\n", "volume", "function", "view",
                  "asked", "got", "samples / as good as got", "as asked");
  std::ptrdiff_t fewer = 0;
  for (const Row& row : rows) {
    text += fmt::format("{:28} {:8} {:>4g},{:>4g} {:>9} {:10.2g} {:>22} {:>12}{}\n", row.volume,
                        row.function, row.azimuthDeg, row.elevationDeg,
                        fmt::format("1/{:.0f}", 1 / row.asked), row.errorMax,
                        ratioText(row, row.asGood), ratioText(row, row.asAsked),
                        row.errorMax <= row.asked ? "" : "  NOT KEPT");
    if (ratio(row, row.asGood).value_or(0) <= 1) ++fewer;
  }
  const auto kept =
      std::ranges::count_if(rows, [](const Row& row) { return row.errorMax <= row.asked; });
  double change = 0;
  for (const Row& row : rows) change = std::max(change, row.truthChange);
  return text + fmt::format(
                    "{} of {} pictures keep what was asked; {} need no more samples than the "
                    "cheapest fixed step as good\nthe truth is known to about {:.2g}\n",
                    kept, rows.size(), fewer, change);
}

}  // namespace burin::host::bench
