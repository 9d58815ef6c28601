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

inline DrawnAndTrue drawWithReference(const Scene& scene, node::BrickSource& source,
                                      const Camera& camera,
                                      const node::WorkerOptions& options = {}) {
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, options};
  RankStatistics statistics;
  DrawnAndTrue both{drawFrame(worker, scene, camera, statistics), {}};
  const node::ReferenceRenderer reference{scene, source,
                                          node::surveyedScales(worker.survey(), scene)};
  for (const glm::dvec4& p : reference.render(camera, 0, camera.image.height, 2))
    both.truth.push_back({p.r, p.g, p.b, p.a});
  return both;
}

inline Difference againstReference(const Scene& scene, node::BrickSource& source,
                                   const Camera& camera, const node::WorkerOptions& options = {}) {
  const DrawnAndTrue both = drawWithReference(scene, source, camera, options);
  EXPECT_GT(largestAlpha(both.drawn), 0.1) << "an empty picture proves nothing";
  return both.difference();
}

}  // namespace burin::test
