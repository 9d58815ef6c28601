#include "bench/compositing_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>

#include "bench/exact_frame.hpp"
#include "bench/median.hpp"

namespace burin::host::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// Collective. This rank's milliseconds of one composite. The barrier is MPI's own: waiting idly
/// would let the ranks off up to 2 ms apart.
double timeOnce(const Communicator& comm, Contender& contender, const CompositingInput& input) {
  contender.setImage(input.mine);
  checkMpi(MPI_Barrier(comm.get()), "MPI_Barrier");
  const auto start = Clock::now();
  contender.composite(input.order, Collect::kYes);
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::int64_t bytesOfAll(const Communicator& comm, const Contender& contender) {
  std::int64_t bytes = contender.bytesSent();
  allReduce(comm, std::span{&bytes, 1}, MPI_SUM);
  return bytes;
}

CompositingMeasurement warmUp(const Communicator& comm, Contender& contender,
                              const CompositingInput& input, const ExactFrame& exact,
                              const FrameModel& model) {
  CompositingMeasurement row;
  row.peer = contender.peer();
  row.schedule = contender.schedule();
  row.ranks = comm.size();
  row.frame = input.mine.frame;
  row.activeFraction = input.activeFraction;
  row.input = input.name;
  contender.setImage(input.mine);
  contender.composite(input.order, Collect::kNo);
  row.bytesCompose = bytesOfAll(comm, contender);
  contender.setImage(input.mine);
  const auto frame = contender.composite(input.order, Collect::kYes);
  row.bytesTotal = bytesOfAll(comm, contender);
  if (comm.isRoot()) row.largestError = exact.largestDifference(frame);
  row.modelledMs = predictedMs(comm, contender, model);
  return row;
}

}  // namespace

std::vector<CompositingMeasurement> measureCompositing(const Communicator& comm,
                                                       std::span<const Contenders> peers,
                                                       const CompositingInput& input,
                                                       const FrameModel& model, int repeats) {
  const ExactFrame exact{comm, input};
  std::vector<Contender*> all;
  for (const Contenders& contenders : peers)
    for (const auto& contender : contenders) all.push_back(contender.get());
  std::vector<CompositingMeasurement> rows;
  for (Contender* contender : all) rows.push_back(warmUp(comm, *contender, input, exact, model));

  const auto rounds = static_cast<std::size_t>(repeats);
  std::vector<double> times(all.size() * rounds);  // contender by contender
  std::vector<std::size_t> turns(all.size());
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  std::mt19937 random{1};
  for (std::size_t round = 0; round < rounds; ++round) {
    // Another order every round, the same on all ranks: what ran just before leaves the caches warm
    // or cold.
    std::ranges::shuffle(turns, random);
    for (const std::size_t i : turns) {
      times[i * rounds + round] = timeOnce(comm, *all[i], input);
    }
  }
  allReduce(comm, times, MPI_MAX);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto mine = std::span{times}.subspan(i * rounds, rounds);
    std::ranges::sort(mine);
    rows[i].repeats = repeats;
    rows[i].medianMs = median({mine.begin(), mine.end()});
    rows[i].smallestMs = mine.front();
    rows[i].largestMs = mine.back();
  }
  return rows;
}

}  // namespace burin::host::bench
