#include "burin/compositor/pending_send.hpp"

#include <utility>

namespace burin::compositor {

PendingSend::PendingSend(const Communicator& comm, Rank receiver, Tag tag, MessageBuffer message)
    : message_{std::move(message)} {
  const auto bytes = message_.bytes();
  checkMpi(MPI_Isend(bytes.data(), mpiCount(bytes.size()), MPI_BYTE, static_cast<int>(receiver),
                     static_cast<int>(tag), comm.get(), &request_),
           "MPI_Isend");
}

PendingSend::PendingSend(PendingSend&& other) noexcept
    : message_{std::move(other.message_)},
      request_{std::exchange(other.request_, MPI_REQUEST_NULL)} {}

PendingSend& PendingSend::operator=(PendingSend&& other) noexcept {
  std::swap(message_, other.message_);
  std::swap(request_, other.request_);
  return *this;
}

PendingSend::~PendingSend() {
  // Only while an exception ends the program: MPI may still read the buffer, so it is not freed.
  if (request_ != MPI_REQUEST_NULL) static_cast<void>(message_.release());
}

void PendingSend::wait() {
  waitIdle(request_, "a pixel message to be taken");
}

MPI_Request beginReceive(const Communicator& comm, Rank sender, Tag tag,
                         std::span<std::byte> buffer) {
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Irecv(buffer.data(), mpiCount(buffer.size()), MPI_BYTE, static_cast<int>(sender),
                     static_cast<int>(tag), comm.get(), &request),
           "MPI_Irecv");
  return request;
}

std::span<const std::byte> finishReceive(MPI_Request& request, std::span<const std::byte> buffer) {
  const MPI_Status status = waitIdle(request, "pixels of another rank");
  int count = 0;
  checkMpi(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
  return buffer.first(static_cast<std::size_t>(count));
}

}  // namespace burin::compositor
