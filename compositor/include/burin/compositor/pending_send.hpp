#pragma once

#include "burin/common/communicator.hpp"
#include "burin/compositor/message_buffer.hpp"

namespace burin::compositor {

/// Tags of the compositor's messages.
enum class Tag : int { kSwap = 1, kGather = 2 };

/// A message on its way: owns the buffer and the request that reads it.
class PendingSend {
 public:
  /// Begins the send and returns at once.
  PendingSend(const Communicator& comm, Rank receiver, Tag tag, MessageBuffer message);
  PendingSend(PendingSend&& other) noexcept;
  PendingSend& operator=(PendingSend&& other) noexcept;
  /// Never communicates: the buffer of a send that nobody waited for is left to MPI.
  ~PendingSend();

  /// Waits idly until the buffer is free again.
  void wait();

 private:
  MessageBuffer message_;
  MPI_Request request_ = MPI_REQUEST_NULL;
};

/// A receive on its way into `buffer`, which must stay: at most buffer.size() bytes from `sender`.
MPI_Request beginReceive(const Communicator& comm, Rank sender, Tag tag,
                         std::span<std::byte> buffer);

/// Waits idly; returns the bytes that came.
std::span<const std::byte> finishReceive(MPI_Request& request, std::span<const std::byte> buffer);

}  // namespace burin::compositor
