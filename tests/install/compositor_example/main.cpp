#include <burin/compositor/compositor.hpp>
#include <cmath>
#include <fstream>
using namespace burin;

/// Every rank draws a half transparent disc, the next one behind it and further right; rank 0
/// writes them over white. Run it as: mpirun -n 3 discs discs.ppm
int main(int argc, char** argv) {
  const MpiRuntime mpi{&argc, &argv};
  const Communicator world{MPI_COMM_WORLD};
  constexpr ImageSize kSize{200, 100};
  const int rank = static_cast<int>(world.rank());
  const int centre = 50 + 100 * rank / world.size();
  compositor::Subimage<Rgba> mine{kSize, {centre - 40, 10, centre + 40, 90}, {}};
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 40; ++x)
      mine.pixels.push_back(x * x + y * y < 1600 ? Rgba{rank % 2 * 0.5f, 0, 0.25f, 0.5f} : Rgba{});
  std::vector<Rank> frontToBack;
  for (int r = 0; r < world.size(); ++r) frontToBack.push_back(Rank{r});

  RankStatistics statistics;
  compositor::Compositor merge{world};
  const auto frame = merge.toRoot<compositor::Over>({}, frontToBack, mine, {}, statistics);
  if (!frame) return 0;  // not rank 0
  std::ofstream file{argc > 1 ? argv[1] : "discs.ppm", std::ios::binary};
  file << "P6 200 100 255\n";
  for (const Rgba& p : frame->pixels())
    for (const float c : {p.r, p.g, p.b})
      file.put(static_cast<char>(std::lround(255 * (c + 1 - p.a))));
}
