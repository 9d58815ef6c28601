#include "bench/compositing_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace {

using Row = CompositingMeasurement;

/// "sparse" (a scene's footprints), "dense" or "disc".
std::string kindOf(const Row& row) {
  return row.input == "dense" || row.input == "disc" ? row.input : "sparse";
}

/// What rows of one input on one rank count have in common.
auto caseOf(const Row& row) {
  return std::tuple{row.input, row.frame.width, row.frame.height, row.activeFraction, row.ranks};
}
/// The same input over all rank counts. A scene's active fraction depends on them.
auto curveOf(const Row& row) {
  const double fraction = row.input == "disc" ? row.activeFraction : 0;
  return std::tuple{row.input, row.frame.width, row.frame.height, fraction};
}

/// A positive figure's geometric mean and largest value.
class Ratios {
 public:
  void add(double ratio) {
    logarithms_ += std::log(ratio);
    worst_ = std::max(worst_, ratio);
    ++count_;
  }
  int count() const { return count_; }
  double mean() const { return std::exp(logarithms_ / count_); }
  double worst() const { return worst_; }

 private:
  double logarithms_ = 0;
  double worst_ = 0;
  int count_ = 0;
};

/// What IceT reaches in one case: its fastest strategy, and the fewest bytes of any.
struct Best {
  const Row* fastest = nullptr;
  std::int64_t fewestCompose = 0;
  std::int64_t fewestTotal = 0;

  void take(const Row& row) {
    const bool isFirst = fastest == nullptr;
    if (isFirst || row.medianMs < fastest->medianMs) fastest = &row;
    fewestCompose = isFirst ? row.bytesCompose : std::min(fewestCompose, row.bytesCompose);
    fewestTotal = isFirst ? row.bytesTotal : std::min(fewestTotal, row.bytesTotal);
  }
};

struct Comparison {
  Ratios time, compose, total, composeToFewest, totalToFewest;

  void add(const Row& row, const Best& best) {
    time.add(row.medianMs / best.fastest->medianMs);
    compose.add(byteRatio(row.bytesCompose, best.fastest->bytesCompose));
    total.add(byteRatio(row.bytesTotal, best.fastest->bytesTotal));
    composeToFewest.add(byteRatio(row.bytesCompose, best.fewestCompose));
    totalToFewest.add(byteRatio(row.bytesTotal, best.fewestTotal));
  }
  /// Nobody may have sent anything: then nothing equals nothing.
  static double byteRatio(std::int64_t mine, std::int64_t theirs) {
    return static_cast<double>(std::max<std::int64_t>(mine, 1)) /
           static_cast<double>(std::max<std::int64_t>(theirs, 1));
  }
};

using KindAndSchedule = std::pair<std::string, std::string>;

/// IceT's two ways of doing one image that are no single-image strategies (icet.hpp).
bool isMultiTile(const Row& row) {
  return row.schedule == "reduce" || row.schedule == "direct";
}

std::string againstIceT(std::span<const Row> rows, bool singleImageOnly) {
  std::map<decltype(caseOf(rows.front())), Best> bests;
  for (const Row& row : rows) {
    if (row.peer == "icet" && !(singleImageOnly && isMultiTile(row))) bests[caseOf(row)].take(row);
  }
  if (bests.empty()) return {};
  std::map<KindAndSchedule, Comparison> comparisons;
  for (const Row& row : rows) {
    if (row.peer == "burin")
      comparisons[{kindOf(row), row.schedule}].add(row, bests.at(caseOf(row)));
  }
  std::string text =
      fmt::format("burin / IceT's best{}, geometric means over the cases; below 1 is better\n",
                  singleImageOnly ? " single-image strategy" : "");
  text += fmt::format("  {:<8}{:<12}{:>6}{:>9}{:>9}{:>22}{:>22}\n", "", "", "", "time", "",
                      "bytes, to fastest", "bytes, to fewest");
  text += fmt::format("  {:<8}{:<12}{:>6}{:>9}{:>9}{:>11}{:>11}{:>11}{:>11}\n", "kind", "schedule",
                      "cases", "mean", "worst", "compose", "total", "compose", "total");
  for (const auto& [key, c] : comparisons) {
    text += fmt::format("  {:<8}{:<12}{:>6}{:>9.3f}{:>9.3f}{:>11.3f}{:>11.3f}{:>11.3f}{:>11.3f}\n",
                        key.first, key.second, c.time.count(), c.time.mean(), c.time.worst(),
                        c.compose.mean(), c.total.mean(), c.composeToFewest.mean(),
                        c.totalToFewest.mean());
  }
  return text;
}

/// Time on `ranks` by the curve through the powers of two around it; nullopt without them.
std::optional<double> interpolated(const std::map<int, double>& msByRanks, int ranks) {
  const auto below = static_cast<int>(std::bit_floor(static_cast<unsigned>(ranks)));
  const auto low = msByRanks.find(below);
  const auto high = msByRanks.find(2 * below);
  if (low == msByRanks.end() || high == msByRanks.end()) return std::nullopt;
  const double t = std::log2(static_cast<double>(ranks) / below);
  return (1 - t) * low->second + t * high->second;
}

std::string betweenPowersOfTwo(std::span<const Row> rows) {
  using Curve = std::tuple<KindAndSchedule, decltype(curveOf(rows.front()))>;
  std::map<Curve, std::map<int, double>> curves;
  for (const Row& row : rows) {
    if (row.peer == "burin")
      curves[{{kindOf(row), row.schedule}, curveOf(row)}][row.ranks] = row.medianMs;
  }
  std::map<KindAndSchedule, Ratios> ratios;
  for (const auto& [curve, msByRanks] : curves) {
    for (const auto& [ranks, ms] : msByRanks) {
      if (std::has_single_bit(static_cast<unsigned>(ranks))) continue;
      if (const auto wanted = interpolated(msByRanks, ranks))
        ratios[std::get<0>(curve)].add(ms / *wanted);
    }
  }
  if (ratios.empty()) return {};
  std::string text = "other rank counts / interpolation between powers of two, time\n";
  for (const auto& [key, r] : ratios)
    text += fmt::format("  {:<8}{:<12}{:>6}{:>9.3f}{:>9.3f}\n", key.first, key.second, r.count(),
                        r.mean(), r.worst());
  return text;
}

}  // namespace

std::string compositingCsv(std::span<const Row> rows, std::string_view network) {
  std::string text =
      "peer,pixel,schedule,ranks,width,height,active_fraction,network,median_ms,bytes_compose,"
      "bytes_total,case,smallest_ms,largest_ms,repeats,error_max,modelled_ms\n";
  for (const Row& row : rows) {
    text += fmt::format(
        "{},rgba-float,{},{},{},{},{:.6g},{},{:.4f},{},{},{},{:.4f},{:.4f},{},"
        "{:.3g},{}\n",
        row.peer, row.schedule, row.ranks, row.frame.width, row.frame.height, row.activeFraction,
        network, row.medianMs, row.bytesCompose, row.bytesTotal, row.input, row.smallestMs,
        row.largestMs, row.repeats, row.largestError,
        row.modelledMs > 0 ? fmt::format("{:.4f}", row.modelledMs) : "NaN");
  }
  return text;
}

std::string caseLine(std::span<const Row> rows) {
  const auto fastest = [&](std::string_view peer) {
    const Row* best = nullptr;
    for (const Row& row : rows) {
      if (row.peer == peer && (best == nullptr || row.medianMs < best->medianMs)) best = &row;
    }
    return best;
  };
  const Row& any = rows.front();
  std::string text =
      fmt::format("{:<12}{:>5}x{:<5}{:>2} ranks{:>7.2f} %", any.input, any.frame.width,
                  any.frame.height, any.ranks, 100 * any.activeFraction);
  const Row* const burin = fastest("burin");
  const Row* const icet = fastest("icet");
  if (burin != nullptr)
    text += fmt::format("   burin {:<9}{:>9.3f} ms", burin->schedule, burin->medianMs);
  if (icet != nullptr)
    text += fmt::format("   IceT {:<14}{:>9.3f} ms", icet->schedule, icet->medianMs);
  if (burin != nullptr && icet != nullptr)
    text += fmt::format("   {:.3f}", burin->medianMs / icet->medianMs);
  return text + "\n";
}

std::string compositingSummary(std::span<const Row> rows) {
  return againstIceT(rows, true) + againstIceT(rows, false) + betweenPowersOfTwo(rows);
}

}  // namespace burin::host::bench
