#pragma once

#include <concepts>
#include <functional>
#include <string_view>
#include <utility>

#include "burin/common/communicator.hpp"
#include "burin/common/error.hpp"

namespace burin::host {

/// An error that all ranks throw together and in the same words, so that it concerns no rank in
/// particular: a bad scene, a missing file, a full disk at rank 0. Rank 0 says it for all.
class SharedError : public Error {
 public:
  using Error::Error;
};

/// Collective. Returns if nobody failed; throws SharedError on all ranks if all failed in the same
/// words, CollectiveError (which names a rank) if only some did, or in different words.
void agreeTogether(const Communicator& comm, std::string_view what, const Outcome& mine);

/// Collective. Throws SharedError on all ranks if `root`, rank 0's outcome, is a failure; the
/// other ranks' argument does not matter.
void agreeWithRoot(const Communicator& comm, const Outcome& root);

/// Collective. Local `work` that should come out alike on all ranks, e.g. opening the volume.
template <std::invocable Work>
void together(const Communicator& comm, std::string_view what, Work&& work) {
  agreeTogether(comm, what, attempt(std::forward<Work>(work)));
}

/// Collective. Local `work` for rank 0 alone, e.g. writing a picture; the others wait for it.
template <std::invocable Work>
void onRoot(const Communicator& comm, Work&& work) {
  agreeWithRoot(comm, comm.isRoot() ? attempt(std::forward<Work>(work)) : Outcome{});
}

}  // namespace burin::host
