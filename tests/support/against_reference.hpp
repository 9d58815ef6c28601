#pragma once

#include <gtest/gtest.h>

#include "support/drawing.hpp"

namespace burin::test {

/// Contract of the project: 1e-4 at any channel on smooth volumes, at the same step.
inline constexpr double kReferenceBound = 1e-4;

struct ReferencePixel {
  double r, g, b, a;
};

/// A picture and the double-precision truth of the same scene.
struct DrawnAndTrue {
  Image<Rgba> drawn;
  std::vector<ReferencePixel> truth;

  Difference difference() const {
    return test::difference(drawn.pixels(), std::span<const ReferencePixel>{truth});
  }
};

/// A scene drawn and its truth, for as many views as one likes: making both takes longer than a
/// picture.
class ComparedScene {
 public:
  explicit ComparedScene(const Scene& scene, node::BrickSource& source,
                         const node::WorkerOptions& options = {})
      : scene_{scene},
        worker_{self_, scene, source, options},
        reference_{scene, source, node::surveyedScales(worker_.survey(), scene)} {}

  /// The scene's own camera does not count.
  DrawnAndTrue draw(const Camera& camera) {
    RankStatistics statistics;
    DrawnAndTrue both{drawFrame(worker_, scene_, camera, statistics), {}};
    for (const glm::dvec4& p : reference_.render(camera, 0, camera.image.height, 2))
      both.truth.push_back({p.r, p.g, p.b, p.a});
    return both;
  }

  /// Fails where the picture is empty.
  Difference difference(const Camera& camera) {
    const DrawnAndTrue both = draw(camera);
    EXPECT_GT(largestAlpha(both.drawn), 0.1) << "an empty picture proves nothing";
    return both.difference();
  }

 private:
  const Communicator self_{MPI_COMM_SELF};
  const Scene scene_;
  node::Worker worker_;
  const node::ReferenceRenderer reference_;
};

inline DrawnAndTrue drawWithReference(const Scene& scene, node::BrickSource& source,
                                      const Camera& camera,
                                      const node::WorkerOptions& options = {}) {
  return ComparedScene{scene, source, options}.draw(camera);
}

inline Difference againstReference(const Scene& scene, node::BrickSource& source,
                                   const Camera& camera, const node::WorkerOptions& options = {}) {
  return ComparedScene{scene, source, options}.difference(camera);
}

}  // namespace burin::test
