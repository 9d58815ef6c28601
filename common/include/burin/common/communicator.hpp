#pragma once

#include <mpi.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"

namespace burin {

/// An index into a communicator: not a brick, not an owner of the k-d tree.
enum class Rank : int {};

/// MPI_Init_thread(FUNNELED) … MPI_Finalize. One per process, made by main alone. An exception that
/// only this rank has must be caught inside its lifetime: finalizing waits for the other ranks.
class MpiRuntime {
 public:
  /// Throws Error{kRank} if MPI cannot start or gives no MPI_THREAD_FUNNELED.
  MpiRuntime(int* argc, char*** argv);
  ~MpiRuntime();  ///< finalizes unless someone has already
  MpiRuntime(const MpiRuntime&) = delete;
  MpiRuntime& operator=(const MpiRuntime&) = delete;
};

/// A duplicate of a communicator, so that our tags meet nobody else's. Its MPI errors are return
/// codes, for checkMpi. Move-only; must end before MPI is finalized.
class Communicator {
 public:
  /// Collective over `parent`.
  explicit Communicator(MPI_Comm parent);
  Communicator(Communicator&&) noexcept;
  Communicator& operator=(Communicator&&) noexcept;
  ~Communicator();

  Rank rank() const { return rank_; }
  int size() const { return size_; }
  bool isRoot() const { return rank_ == Rank{0}; }
  MPI_Comm get() const { return comm_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  Rank rank_{0};
  int size_ = 1;
};

/// Throws Error{kRank} naming `call` and MPI's own text unless `code` is MPI_SUCCESS.
void checkMpi(int code, const char* call);

/// Waits until the requests are done without burning a core: test for at most 20 µs, then sleep
/// between tests, backing off from 50 µs to 2 ms. The requests become MPI_REQUEST_NULL. Every wait
/// of the program ends up here. Throws Error{kRank} that names `what` was awaited if MPI reports an
/// error.
MPI_Status waitIdle(MPI_Request& request, const char* what = "a message");
void waitIdle(std::span<MPI_Request> requests, const char* what = "messages");
/// Likewise, until `isDone()`, which does the testing.
void waitUntil(const std::function<bool()>& isDone, const char* what = "messages");

/// Called with what is awaited, ten times a second, by every wait that lasts so long, on the thread
/// that waits. What it throws ends the wait. One for the whole process, none at first; the
/// program's own business, as it may know that nobody will ever answer.
void setWaitWatch(std::function<void(const char* what)> watch);
/// Calls it, for waits of other kinds than the above.
void watchWait(const char* what);

/// Narrows to the counts MPI takes. Throws Error{kRank} above their range.
int mpiCount(std::size_t count);

/// Collectives that wait idly. Collective over `comm`.
void barrier(const Communicator& comm);
/// All ranks pass spans of one length.
void broadcastBytes(const Communicator& comm, std::span<std::byte> bytes, Rank root);
/// Text of any length; on ranks other than `root` the argument does not matter.
std::string broadcastText(const Communicator& comm, std::string text, Rank root);
/// Element by element, in place; all ranks pass spans of one length.
void allReduce(const Communicator& comm, std::span<double> values, MPI_Op op);
void allReduce(const Communicator& comm, std::span<std::int64_t> values, MPI_Op op);
/// Every rank's bytes (equal sizes) in rank order, on all ranks.
std::vector<std::byte> allGatherBytes(const Communicator& comm, std::span<const std::byte> mine);

template <typename T>
requires std::is_trivially_copyable_v<T> std::vector<T> allGather(const Communicator& comm,
                                                                  const T& mine);

/// Thrown on all ranks alike: what failed, on which (lowest) rank, and its message.
class CollectiveError : public Error {
 public:
  CollectiveError(ExitCode code, std::string_view what, Rank culprit, const std::string& reason);
  Rank culprit() const { return culprit_; }

 private:
  Rank culprit_;
};

/// What one rank's local work came to; agreed on by all ranks in `agree`.
struct Outcome {
  bool failed = false;
  ExitCode code = ExitCode::kRank;
  std::string reason;
};

/// Collective. Returns on all ranks if nobody failed, else throws CollectiveError on all of them,
/// naming the lowest failing rank with its message and exit code.
void agree(const Communicator& comm, std::string_view what, Outcome mine);

/// Local. Runs `work` and turns an exception into a failed Outcome.
template <std::invocable Work>
Outcome attempt(Work&& work) {
  try {
    std::invoke(std::forward<Work>(work));
  } catch (const Error& e) {
    return {true, e.code(), e.what()};
  } catch (const std::exception& e) {
    return {true, ExitCode::kRank, e.what()};
  } catch (...) {
    return {true, ExitCode::kRank, "unknown exception"};
  }
  return {};
}

/// Collective. Runs `work` on every rank, then returns on all of them or throws CollectiveError on
/// all of them. `work` must be local: an MPI call inside it could be left unmatched.
template <std::invocable Work>
void collectively(const Communicator& comm, std::string_view what, Work&& work) {
  agree(comm, what, attempt(std::forward<Work>(work)));
}

template <typename T>
requires std::is_trivially_copyable_v<T> std::vector<T> allGather(const Communicator& comm,
                                                                  const T& mine) {
  const auto bytes = allGatherBytes(comm, std::as_bytes(std::span{&mine, 1}));
  std::vector<T> all(static_cast<std::size_t>(comm.size()));
  std::memcpy(all.data(), bytes.data(), bytes.size());
  return all;
}

}  // namespace burin
