#include "bench/ball_volume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "bench/memory_source.hpp"
#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace {

/// The fractional digits of `index` in some base, mirrored at the point.
double radicalInverse(int index, int base) {
  double value = 0;
  for (double digit = 1.0 / base; index > 0; index /= base, digit /= base)
    value += digit * (index % base);
  return value;
}

/// In voxels. Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
/// multi-dimensional integrals", 1960, bases 2, 3, 5; away from the volume's faces.
std::vector<glm::vec3> centres(int count, int side) {
  constexpr double kMargin = 0.12;
  if (count == 1) return {glm::vec3{0.5F * static_cast<float>(side - 1)}};
  std::vector<glm::vec3> all;
  for (int i = 1; i <= count; ++i) {
    const glm::dvec3 unit{radicalInverse(i, 2), radicalInverse(i, 3), radicalInverse(i, 5)};
    all.emplace_back((kMargin + (1 - 2 * kMargin) * unit) * static_cast<double>(side - 1));
  }
  return all;
}

/// Of each voxel to the nearest of the centres.
std::vector<float> distances(const std::vector<glm::vec3>& centres, int side) {
  std::vector<float> all;
  all.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
              static_cast<std::size_t>(side));
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        float nearest = INFINITY;
        for (const glm::vec3& centre : centres) {
          const glm::vec3 away = glm::vec3{x, y, z} - centre;
          nearest = std::min(nearest, glm::dot(away, away));
        }
        all.push_back(std::sqrt(nearest));
      }
    }
  }
  return all;
}

/// That `fraction` of the distances stay below; beyond all of them for a fraction of 1.
float radiusFor(std::vector<float> distances, double fraction) {
  const auto inside =
      static_cast<std::size_t>(std::round(fraction * static_cast<double>(distances.size())));
  if (inside >= distances.size()) return INFINITY;
  const auto last = distances.begin() + static_cast<std::ptrdiff_t>(inside);
  std::nth_element(distances.begin(), last, distances.end());
  return *last;
}

}  // namespace

std::unique_ptr<node::BrickSource> makeBalls(int count, double fraction, int side) {
  BURIN_CHECK(count >= 1 && side >= 2 && fraction > 0 && fraction <= 1);
  node::VolumeInfo info;
  info.name = fmt::format("{} balls", count);
  info.format = "procedural";
  info.grid.dims = glm::ivec3{side};
  const auto away = distances(centres(count, side), side);
  const float radius = radiusFor(away, fraction);
  std::vector<std::byte> voxels(away.size());
  std::ranges::transform(away, voxels.begin(), [&](float distance) {
    return distance < radius ? std::byte{255} : std::byte{0};
  });
  return std::make_unique<MemorySource>(std::move(info), std::move(voxels));
}

}  // namespace burin::host::bench
