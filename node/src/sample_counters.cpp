#include "sample_counters.hpp"

#include <algorithm>
#include <array>

namespace burin::node {

using Counts = std::array<GLuint, 4>;  // Counters in ownership.glsl

SampleCounters::SampleCounters() : buffer_{makeBuffer()} {
  gl().NamedBufferStorage(buffer_.id(), sizeof(Counts), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void SampleCounters::begin() {
  constexpr Counts kZero{};
  gl().NamedBufferSubData(buffer_.id(), 0, sizeof(kZero), kZero.data());
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer_.id());
}

void SampleCounters::addTo(RankStatistics& statistics) {
  Counts counts{};
  gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl().GetNamedBufferSubData(buffer_.id(), 0, sizeof(counts), counts.data());
  statistics.samplesVisited += counts[0];
  statistics.samplesShaded += counts[1];
  statistics.samplesInOccupiedCells += counts[2];
  statistics.leaps += counts[3];
}

void drawFullscreen(std::optional<SampleCounters>& counters, const PixelRect& pixels,
                    double samples, RankStatistics& statistics) {
  if (!counters) {
    gl().Scissor(pixels.x0, pixels.y0, pixels.width(), pixels.height());
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  const int rows = std::max(1, static_cast<int>(0x1p32 / samples / pixels.width()));
  for (int y = pixels.y0; y < pixels.y1; y += rows) {
    counters->begin();
    gl().Scissor(pixels.x0, y, pixels.width(), std::min(rows, pixels.y1 - y));
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    counters->addTo(statistics);
  }
}

double mostPlanes(const VolumeGrid& grid, double stepVoxels) {
  return 2 * grid.boundingRadius() / (stepVoxels * grid.smallestSpacing()) + 2;
}

}  // namespace burin::node
