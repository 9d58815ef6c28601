#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>
#include <vector>

#include "burin/common/error.hpp"
#include "slab_reading.hpp"

namespace burin::node {
namespace {

constexpr int kTag = 1;

/// What `work` came to, as `collectively` would say it.
template <typename Work>
Outcome outcomeOf(Work&& work) {
  try {
    work();
    return {};
  } catch (const Error& e) {
    return {true, e.code(), e.what()};
  } catch (const std::exception& e) {
    return {true, ExitCode::kRank, e.what()};
  }
}

/// Every rank's boxes, by rank. Collective.
std::vector<std::vector<IndexBox>> gatherBoxes(const Communicator& comm,
                                               std::span<const IndexBox> mine) {
  const auto counts = allGather(comm, static_cast<std::int64_t>(mine.size()));
  const auto most = static_cast<std::size_t>(*std::max_element(counts.begin(), counts.end()));
  std::vector<IndexBox> padded(mine.begin(), mine.end());
  padded.resize(most);  // equal sizes: empty boxes
  const auto bytes = allGatherBytes(comm, std::as_bytes(std::span{padded}));
  std::vector<std::vector<IndexBox>> all;
  for (std::size_t rank = 0; rank < counts.size(); ++rank) {
    auto& boxes = all.emplace_back(most);
    if (most == 0) continue;
    std::memcpy(boxes.data(), bytes.data() + rank * most * sizeof(IndexBox),
                most * sizeof(IndexBox));
  }
  return all;
}

/// The slabs that the root reads, ascending: whole in x and y, those that some rank needs.
std::vector<IndexBox> planSlabs(const glm::ivec3& dims, int thickness,
                                const std::vector<std::vector<IndexBox>>& boxes) {
  std::vector<IndexBox> slabs;
  for (int z = 0; z < dims.z; z += std::min(thickness, dims.z - z)) {
    const IndexBox slab{{0, 0, z}, {dims.x, dims.y, z + std::min(thickness, dims.z - z)}};
    const bool needed = std::ranges::any_of(boxes, [&](const auto& ofRank) {
      return std::ranges::any_of(
          ofRank, [&](const IndexBox& box) { return !intersection(box, slab).empty(); });
    });
    if (needed) slabs.push_back(slab);
  }
  return slabs;
}

/// Messages on their way, with their voxels; never more bytes than the limit unless it is one
/// message alone.
class PendingSends {
 public:
  PendingSends(const Communicator& comm, std::size_t limit) : comm_{comm}, limit_{limit} {}

  void send(std::vector<std::byte> voxels, int rank) {
    while (!pending_.empty() && bytes_ + voxels.size() > limit_) finishOldest();
    bytes_ += voxels.size();
    Send& send = pending_.emplace_back(Send{MPI_REQUEST_NULL, std::move(voxels)});
    checkMpi(MPI_Isend(send.voxels.data(), mpiCount(send.voxels.size()), MPI_BYTE, rank, kTag,
                       comm_.get(), &send.request),
             "MPI_Isend");
  }

  void finish() {
    while (!pending_.empty()) finishOldest();
  }

 private:
  struct Send {
    MPI_Request request;
    std::vector<std::byte> voxels;
  };

  void finishOldest() {
    waitIdle(pending_.front().request, "voxels to be taken");
    bytes_ -= pending_.front().voxels.size();
    pending_.pop_front();
  }

  const Communicator& comm_;
  std::size_t limit_;
  std::size_t bytes_ = 0;
  std::deque<Send> pending_;  // a deque: requests must not move while MPI knows them
};

/// Both sides of the scatter know all boxes and all slabs, so they agree on the messages: one per
/// slab, rank and box that meet, in that order. A message of no bytes says that the root failed and
/// that nothing more follows for this rank.
struct Scatter {
  const Communicator& comm;
  BrickSource& source;
  const DeliverSlab& deliver;
  std::vector<std::vector<IndexBox>> boxes;
  std::vector<IndexBox> slabs;

  std::vector<std::size_t> sent = std::vector<std::size_t>(boxes.size());  ///< root: by rank

  std::size_t voxelBytes() const { return bytesPerVoxel(source.info().type); }

  /// Calls work(request, part) for each part of the slab that `rank` wants.
  template <typename Work>
  void forParts(std::size_t rank, const IndexBox& slab, Work&& work) const {
    for (std::size_t request = 0; request < boxes[rank].size(); ++request) {
      const IndexBox part = intersection(boxes[rank][request], slab);
      if (!part.empty()) work(request, part);
    }
  }

  void sendSlab(const IndexBox& slab, std::span<const std::byte> voxels, PendingSends& sends) {
    for (std::size_t rank = 0; rank < boxes.size(); ++rank) {
      forParts(rank, slab, [&](std::size_t request, const IndexBox& part) {
        if (rank == 0 && part == slab) {
          deliver({request, part, voxels});
          return;
        }
        std::vector<std::byte> packed(part.count() * voxelBytes());
        copyVoxels(voxels, slab, packed, part, part, voxelBytes());
        if (rank == 0) {
          deliver({request, part, packed});
        } else {
          sends.send(std::move(packed), static_cast<int>(rank));
          ++sent[rank];
        }
      });
    }
  }

  Outcome readAndSend(std::size_t pendingLimit) {
    PendingSends sends{comm, pendingLimit};
    const Outcome outcome = outcomeOf([&] {
      std::vector<std::byte> voxels;
      for (const IndexBox& slab : slabs) {
        voxels.resize(slab.count() * voxelBytes());
        source.load(slab, voxels);
        sendSlab(slab, voxels, sends);
      }
    });
    if (outcome.failed) tellFailure(sends);
    sends.finish();
    return outcome;
  }

  /// One empty message to each rank that still waits for some.
  void tellFailure(PendingSends& sends) {
    for (std::size_t rank = 1; rank < boxes.size(); ++rank) {
      std::size_t expected = 0;
      for (const IndexBox& slab : slabs) {
        forParts(rank, slab, [&](std::size_t, const IndexBox&) { ++expected; });
      }
      if (sent[rank] < expected) sends.send({}, static_cast<int>(rank));
    }
  }

  /// Takes every message even after a callback failed: the root cannot know, and sends them.
  Outcome receive() {
    Outcome outcome;
    bool rootFailed = false;
    std::vector<std::byte> voxels;
    const auto self = static_cast<std::size_t>(comm.rank());
    for (std::size_t slab = 0; slab < slabs.size() && !rootFailed; ++slab) {
      forParts(self, slabs[slab], [&](std::size_t request, const IndexBox& part) {
        if (rootFailed) return;
        voxels.resize(part.count() * voxelBytes());
        rootFailed = !receiveInto(voxels);
        if (rootFailed || outcome.failed) return;
        outcome = outcomeOf([&] { deliver({request, part, voxels}); });
      });
    }
    return outcome;
  }

  /// False if the message says that the root failed.
  bool receiveInto(std::span<std::byte> voxels) {
    MPI_Request request = MPI_REQUEST_NULL;
    checkMpi(
        MPI_Irecv(voxels.data(), mpiCount(voxels.size()), MPI_BYTE, 0, kTag, comm.get(), &request),
        "MPI_Irecv");
    const MPI_Status status = waitIdle(request, "voxels from rank 0");
    int received = 0;
    checkMpi(MPI_Get_count(&status, MPI_BYTE, &received), "MPI_Get_count");
    return received != 0;
  }
};

}  // namespace

Outcome scatterSlabs(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
                     const DeliverSlab& deliver, std::size_t slabBytes) {
  const VolumeInfo& info = source.info();
  const std::size_t sliceBytes = info.bytes() / static_cast<std::size_t>(info.grid.dims.z);
  if (comm.size() > 1 && sliceBytes > std::size_t{std::numeric_limits<int>::max()}) {
    return {true, ExitCode::kVolume,
            fmt::format("{}: a compressed slice of {} bytes is too large for more than one rank",
                        info.name, sliceBytes)};
  }
  Scatter scatter{comm, source, deliver, gatherBoxes(comm, boxes), {}};
  // Half for the slab itself, half for the copies that are on their way.
  const int thickness = slicesPerSlab(sliceBytes, slabBytes / 2);
  scatter.slabs = planSlabs(info.grid.dims, thickness, scatter.boxes);
  return comm.isRoot() ? scatter.readAndSend(slabBytes / 2) : scatter.receive();
}

}  // namespace burin::node
