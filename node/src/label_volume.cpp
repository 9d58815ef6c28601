#include "burin/node/label_volume.hpp"

#include <cstring>

#include "burin/common/error.hpp"
#include "burin/common/trace.hpp"
#include "burin/node/survey.hpp"
#include "label_voxels.hpp"
#include "sets_of_cubes.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kMostLabels = std::size_t{1} << 16;

std::string triple(const glm::dvec3& v) {
  return fmt::format("{:.7g} {:.7g} {:.7g}", v.x, v.y, v.z);
}

/// What differs first between two grids whose voxels lie elsewhere: "spacing 1 1 1 and 1 1 2".
std::string difference(const VolumeGrid& a, const VolumeGrid& b, double allowed) {
  const glm::dvec3 cells = glm::max(glm::dvec3{a.dims - 1}, 1.0);
  if (glm::any(glm::greaterThan(glm::abs(a.spacing - b.spacing) * cells, glm::dvec3{allowed})))
    return fmt::format("spacing {} and {}", triple(a.spacing), triple(b.spacing));
  for (int axis = 0; axis < 3; ++axis) {
    const double length = cells[axis] * a.spacing[axis];
    if (glm::distance(a.direction[axis], b.direction[axis]) * length > allowed)
      return fmt::format("direction of {} {} and {}", "xyz"[axis], triple(a.direction[axis]),
                         triple(b.direction[axis]));
  }
  return fmt::format("origin {} and {}", triple(a.origin), triple(b.origin));
}

/// The largest distance of a voxel to the one of the same index: that of one of the corners.
double largestShift(const VolumeGrid& a, const VolumeGrid& b) {
  double shift = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 index =
        glm::dvec3{corner & 1, (corner >> 1) & 1, corner >> 2} * glm::dvec3{a.dims - 1};
    shift = std::max(shift, glm::distance(a.worldFromIndex(index), b.worldFromIndex(index)));
  }
  return shift;
}

/// What one rank found of the labels.
struct LabelCount {
  std::int64_t label, voxels;
};

/// Collective. Counts of all ranks together.
std::map<int, std::int64_t> merged(const Communicator& comm,
                                   const std::map<int, std::int64_t>& mine) {
  std::int64_t most = static_cast<std::int64_t>(mine.size());
  allReduce(comm, std::span{&most, 1}, MPI_MAX);
  std::vector<LabelCount> counts;
  for (const auto& [label, voxels] : mine) counts.push_back({label, voxels});
  counts.resize(
      static_cast<std::size_t>(most));  // all ranks as many: those of no voxels are nothing
  const auto bytes = allGatherBytes(comm, std::as_bytes(std::span{counts}));
  std::vector<LabelCount> all(bytes.size() / sizeof(LabelCount));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  std::map<int, std::int64_t> sums;
  for (const LabelCount& count : all)
    if (count.voxels > 0) sums[static_cast<int>(count.label)] += count.voxels;
  return sums;
}

void countLabels(const VolumeInfo& info, std::span<const int> labels,
                 std::map<int, std::int64_t>& voxels) {
  for (std::size_t i = 0; i < labels.size();) {
    std::size_t end = i + 1;
    while (end < labels.size() && labels[end] == labels[i]) ++end;
    voxels[labels[i]] += static_cast<std::int64_t>(end - i);
    i = end;
  }
  if (voxels.size() > kMostLabels)
    fail(ExitCode::kVolume, "{}: more than {} different values (expected a few labels)", info.name,
         kMostLabels);
}

CubeGrid blocksOf(const VolumeGrid& grid) {
  const int cells = blockCellsFor(grid.dims);
  return {glm::ivec3{0}, (grid.cells() + cells - 1) / cells, cells};
}

}  // namespace

void checkLabelVolume(const VolumeInfo& volume, const VolumeInfo& labels) {
  const VolumeGrid& a = volume.grid;
  const VolumeGrid& b = labels.grid;
  const auto refuse = [&](const std::string& what) {
    fail(ExitCode::kVolume, "{} and its labels {} must have the same grid, but differ: {}",
         volume.name, labels.name, what);
  };
  if (a.dims != b.dims)
    refuse(fmt::format("{} x {} x {} and {} x {} x {} voxels", a.dims.x, a.dims.y, a.dims.z,
                       b.dims.x, b.dims.y, b.dims.z));
  const double allowed = 0.01 * a.smallestSpacing();
  if (largestShift(a, b) > allowed) refuse(difference(a, b, allowed));
}

LabelSurvey surveyLabels(const Communicator& comm, BrickSource& labels) {
  const TraceSpan span{"survey"};
  const VolumeInfo& info = labels.info();
  const glm::ivec3 dims = info.grid.dims;
  const auto border = [&](std::int64_t rank) {
    return static_cast<int>(dims.z * rank / comm.size());
  };
  const auto rank = static_cast<std::int64_t>(comm.rank());
  const IndexBox mine{{0, 0, border(rank)}, {dims.x, dims.y, border(rank + 1)}};
  LabelSurvey survey;
  SetsOfCubes<LabelSet> blocks;
  collectively(comm, "making room for the survey", [&] {
    blocks = SetsOfCubes<LabelSet>{blocksOf(info.grid), 0};
  });
  std::vector<int> values;
  std::vector<LabelSet> sets;
  const auto take = [&](const Slab& slab) {
    readLabels(info, slab.voxels, values);
    countLabels(info, values, survey.voxels);
    sets.resize(values.size());
    std::ranges::transform(values, sets.begin(), labelSet);
    blocks.add(slab.box, sets);
  };
  constexpr std::size_t kLabelsOfSlab = std::size_t{1}
                                        << 20;  // each takes 12 bytes beside its voxel
  readSlabs(comm, labels, std::span{&mine, 1}, take, kLabelsOfSlab * bytesPerVoxel(info.type));
  survey.voxels = merged(comm, survey.voxels);
  survey.blocks = blocks.sets();
  static_assert(sizeof(LabelSet) == sizeof(std::int64_t));
  std::vector<std::int64_t> bits(survey.blocks.size());
  std::ranges::transform(survey.blocks, bits.begin(),
                         [](LabelSet set) { return static_cast<std::int64_t>(set); });
  allReduce(comm, std::span{bits}, MPI_BOR);
  std::ranges::transform(bits, survey.blocks.begin(),
                         [](std::int64_t set) { return static_cast<LabelSet>(set); });
  return survey;
}

}  // namespace burin::node
