#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/collect.hpp"
#include "burin/common/communicator.hpp"
#include "burin/compositor/frame_trace.hpp"
#include "burin/compositor/subimage.hpp"

namespace burin::host::bench {

/// One way to composite what the ranks of a communicator drew: a compositor with a schedule.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual std::string_view peer() const = 0;      ///< "burin" or "icet"
  virtual std::string_view schedule() const = 0;  ///< as in compositing.csv

  /// Local, not timed: what this rank drew. Called before every composite(), so that every
  /// contender starts from pixels just written, as a renderer leaves them.
  virtual void setImage(const compositor::Subimage<Rgba>& mine) = 0;

  /// Collective; what is timed. `order`: the ranks that may have drawn something, front to back.
  /// Returns the frame on rank 0 if it is collected, else something that does not matter; lasts
  /// until the next call. Throws on all ranks, or Error{kRank} on one that is lost.
  virtual std::span<const Rgba> composite(std::span<const Rank> order, Collect collect) = 0;

  /// What this rank sent in the last composite().
  virtual std::int64_t bytesSent() const = 0;

  /// What this rank did in the last composite(), to predict its time from; null if not known.
  virtual const compositor::FrameTrace* lastTrace() const { return nullptr; }
};

using Contenders = std::vector<std::unique_ptr<Contender>>;

/// Collective. burin's compositor with each of its schedules. `comm` outlives them.
Contenders burinContenders(const Communicator& comm);

/// Collective. IceT with each of its strategies; none, on all ranks alike, where it cannot be
/// loaded: then `whyNot` says why.
Contenders icetContenders(const Communicator& comm, std::string& whyNot);

}  // namespace burin::host::bench
