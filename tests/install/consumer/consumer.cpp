#include <burin/compositor/compositor.hpp>
#include <cstdio>

using namespace burin;

/// Two ranks draw one half opaque pixel each: one over the other is 0.5 + 0.5 · 0.5 opaque,
/// exactly.
int main(int argc, char** argv) {
  const MpiRuntime mpi{&argc, &argv};
  const Communicator world{MPI_COMM_WORLD};
  const Rank order[] = {Rank{0}, Rank{1}};
  const compositor::Subimage<Rgba> mine{{1, 1}, {0, 0, 1, 1}, {{0.1f, 0.2f, 0.3f, 0.5f}}};
  RankStatistics statistics;
  compositor::Compositor merge{world};
  const auto frame = merge.toRoot<compositor::Over>({}, order, mine, {}, statistics);
  if (frame) std::printf("opacity %.3f of two ranks\n", static_cast<double>(frame->at(0, 0).a));
  return frame && frame->at(0, 0).a != 0.75f ? 1 : 0;
}
