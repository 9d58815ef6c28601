#include "burin/host/shared_error.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace burin::host {

namespace {

/// An outcome in a size that all ranks share.
struct Digest {
  std::int64_t failed = 0;
  std::int64_t code = 0;
  std::uint64_t words = 0;
  friend bool operator==(const Digest&, const Digest&) = default;
};

Digest digest(const Outcome& outcome) {
  if (!outcome.failed) return {};
  return {1, static_cast<std::int64_t>(outcome.code), std::hash<std::string>{}(outcome.reason)};
}

}  // namespace

void agreeTogether(const Communicator& comm, std::string_view what, const Outcome& mine) {
  const auto all = allGather(comm, digest(mine));
  const bool alike =
      std::all_of(all.begin(), all.end(), [&](const Digest& one) { return one == all.front(); });
  if (!alike) agree(comm, what, mine);
  if (mine.failed) throw SharedError{mine.code, mine.reason};
}

void agreeWithRoot(const Communicator& comm, const Outcome& root) {
  std::int64_t failureCode = root.failed ? static_cast<std::int64_t>(root.code) : 0;
  broadcastBytes(comm, std::as_writable_bytes(std::span{&failureCode, 1}), Rank{0});
  if (failureCode == 0) return;
  throw SharedError{ExitCode{static_cast<int>(failureCode)},
                    broadcastText(comm, root.reason, Rank{0})};
}

}  // namespace burin::host
