#include "burin/compositor/mpi_flow.hpp"

#include <algorithm>

namespace burin::compositor {

namespace {

/// A message on its way in: first matched, which tells its length, then received.
struct Incoming {
  MPI_Request request = MPI_REQUEST_NULL;
  bool isMatched = false;
  bool isUsed = false;
};

}  // namespace

void MpiFlow::send(Rank receiver, Tag tag, std::span<const std::byte> message) {
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Isend(message.data(), mpiCount(message.size()), MPI_BYTE, static_cast<int>(receiver),
                     static_cast<int>(tag), comm_->get(), &request),
           "MPI_Isend");
  sending_.push_back(request);
}

void MpiFlow::receive(Tag tag, std::span<Received> messages, const Room& room) {
  receiveEach(tag, messages, room, [](std::size_t) {});
}

void MpiFlow::receiveEach(Tag tag, std::span<Received> messages, const Room& room,
                          const std::function<void(std::size_t)>& use) {
  std::vector<Incoming> incoming(messages.size());
  std::size_t left = messages.size();
  /// Messages of one sender must be matched in their order; in the list they are neighbours.
  const auto isBlocked = [&](std::size_t index) {
    return index > 0 && !incoming[index - 1].isMatched &&
           messages[index - 1].sender == messages[index].sender;
  };
  const auto match = [&](std::size_t i) {
    int isThere = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status{};
    checkMpi(MPI_Improbe(static_cast<int>(messages[i].sender), static_cast<int>(tag), comm_->get(),
                         &isThere, &message, &status),
             "MPI_Improbe");
    if (isThere == 0) return;
    int count = 0;
    checkMpi(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
    const std::span<std::byte> place = room(static_cast<std::size_t>(count));
    messages[i].bytes = place;
    checkMpi(MPI_Imrecv(place.data(), count, MPI_BYTE, &message, &incoming[i].request),
             "MPI_Imrecv");
    incoming[i].isMatched = true;
  };
  waitUntil([&] {
    for (std::size_t i = 0; i < incoming.size(); ++i) {
      if (!incoming[i].isMatched && !isBlocked(i)) match(i);
      if (!incoming[i].isMatched || incoming[i].isUsed) continue;
      int isDone = 0;
      checkMpi(MPI_Test(&incoming[i].request, &isDone, MPI_STATUS_IGNORE), "MPI_Test");
      if (isDone == 0) continue;
      incoming[i].isUsed = true;
      --left;
      use(i);
    }
    return left == 0;
  });
}

void MpiFlow::finish() {
  waitIdle(sending_, "pixel messages to be taken");
  sending_.clear();
}

}  // namespace burin::compositor
