#include "bench/exact_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::host::bench {

ExactFrame::ExactFrame(const Communicator& comm, const CompositingInput& input)
    : frame_{input.mine.frame} {
  const auto active = allGather(comm, input.mine.active);
  if (comm.isRoot()) pixels_.resize(frame_.pixels());
  for (const Rank rank : input.order) {
    const PixelRect& rect = active[static_cast<std::size_t>(rank)];
    const int bytes = mpiCount(rect.pixels() * sizeof(Rgba));
    MPI_Request request = MPI_REQUEST_NULL;
    if (comm.isRoot() && rank == comm.rank()) {
      putBehind(rect, input.mine.pixels);
    } else if (comm.isRoot()) {
      std::vector<Rgba> pixels(rect.pixels());
      checkMpi(MPI_Irecv(pixels.data(), bytes, MPI_BYTE, static_cast<int>(rank), 0, comm.get(),
                         &request),
               "MPI_Irecv");
      waitIdle(request, "a subimage");
      putBehind(rect, pixels);
    } else if (rank == comm.rank()) {
      checkMpi(MPI_Isend(input.mine.pixels.data(), bytes, MPI_BYTE, 0, 0, comm.get(), &request),
               "MPI_Isend");
      waitIdle(request, "rank 0 to take a subimage");
    }
  }
}

void ExactFrame::putBehind(const PixelRect& active, std::span<const Rgba> pixels) {
  auto pixel = pixels.begin();
  for (int y = active.y0; y < active.y1; ++y) {
    auto front = pixels_.begin() + std::ptrdiff_t{y} * frame_.width + active.x0;
    for (int x = active.x0; x < active.x1; ++x, ++pixel, ++front) {
      const double seen = 1 - front->at(3);
      const std::array<float, 4> back{pixel->r, pixel->g, pixel->b, pixel->a};
      for (std::size_t c = 0; c < back.size(); ++c) front->at(c) += seen * double{back.at(c)};
    }
  }
}

double ExactFrame::largestDifference(std::span<const Rgba> frame) const {
  if (frame.size() != pixels_.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::array<float, 4> got{frame[i].r, frame[i].g, frame[i].b, frame[i].a};
    for (std::size_t c = 0; c < got.size(); ++c) {
      const double difference = std::abs(double{got.at(c)} - pixels_[i].at(c));
      // Negated, so that NaN counts as the largest difference there is.
      if (!(difference <= largest))
        largest = std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
    }
  }
  return largest;
}

}  // namespace burin::host::bench
