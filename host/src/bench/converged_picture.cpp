#include "bench/converged_picture.hpp"

#include "bench/frame_copy.hpp"
#include "burin/host/frame_maker.hpp"

namespace burin::host::bench {

Image<Rgba> convergedPicture(const Communicator& comm, PreparedScene& prepared, double allowed,
                             const Camera& camera) {
  prepared.scene.quality = Quality{};
  prepared.scene.quality.maxError = allowed;
  RankStatistics unused;
  const auto frames = makeReferenceFrames(comm, prepared, {}, [](double) {});
  return copyOf(frames->make(camera, unused));
}

}  // namespace burin::host::bench
