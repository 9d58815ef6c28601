#include "sample_counters.hpp"

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

}  // namespace burin::node
