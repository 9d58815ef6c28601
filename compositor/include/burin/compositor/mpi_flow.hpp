#pragma once

#include <functional>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/compositor/received.hpp"

namespace burin::compositor {

/// A MessageFlow (executor.hpp) over MPI: the messages of one frame, by one thread. Lengths need
/// not be known to the receiver. Waits idly. Throws Error{kRank} if MPI fails.
class MpiFlow {
 public:
  explicit MpiFlow(const Communicator& comm) : comm_{&comm} {}
  MpiFlow(const MpiFlow&) = delete;
  MpiFlow& operator=(const MpiFlow&) = delete;

  using Room = std::function<std::span<std::byte>(std::size_t bytes)>;

  void send(Rank receiver, Tag tag, std::span<const std::byte> message);
  void receive(Tag tag, std::span<Received> messages, const Room& room);
  void receiveEach(Tag tag, std::span<Received> messages, const Room& room,
                   const std::function<void(std::size_t index)>& use);
  void finish();

 private:
  const Communicator* comm_;
  std::vector<MPI_Request> sending_;
};

}  // namespace burin::compositor
