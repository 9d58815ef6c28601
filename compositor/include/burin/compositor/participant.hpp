#pragma once

#include <utility>

#include "burin/common/communicator.hpp"
#include "burin/compositor/partial_image.hpp"
#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// What one participant sent and received: whole messages, headers included.
struct Traffic {
  std::int64_t bytesSent = 0;
  std::int64_t bytesReceived = 0;
  std::int64_t messagesSent = 0;
};

/// One participant's part of a schedule, whoever carries the messages. Nothing here throws, since
/// others wait for the messages: after a failure it goes on with no pixels, and the outcome tells.
template <PixelAlgebra A>
class Participant {
 public:
  Participant() = default;
  Participant(const PixelRect& bounds, Subimage<typename A::Pixel> image)
      : image_{bounds, std::move(image)} {}

  /// The message for a send step, or for the gather.
  MessageBuffer encode(const Region& region) {
    MessageBuffer message;
    note(attempt([&] { message = image_.encode(region); }));
    if (outcome_.failed) message = emptyMessage(region);
    traffic_.bytesSent += static_cast<std::int64_t>(message.bytes().size());
    ++traffic_.messagesSent;
    return message;
  }

  /// Carries out a receive step with the message that came from `sender`.
  void receive(const Step& step, Rank sender, std::span<const std::byte> message) {
    image_.narrow(step.region);
    accept(sender, message, [&] { image_.combine(message, step.peerIsInFront); });
  }

  /// Counts a message from `sender` and runs `use` on it, noting its failure.
  template <typename Use>
  void accept(Rank sender, std::span<const std::byte> message, Use&& use) {
    traffic_.bytesReceived += static_cast<std::int64_t>(message.size());
    Outcome outcome = attempt(use);
    outcome.reason =
        fmt::format("message from rank {}: {}", static_cast<int>(sender), outcome.reason);
    note(std::move(outcome));
  }

  /// All steps are done: `owned` is what is left.
  void finish(const Region& owned) { image_.narrow(owned); }

  const PartialImage<A>& image() const { return image_; }
  const Traffic& traffic() const { return traffic_; }
  const Outcome& outcome() const { return outcome_; }  ///< the first failure, if any

 private:
  void note(Outcome outcome) {
    if (outcome.failed && !outcome_.failed) outcome_ = std::move(outcome);
  }

  MessageBuffer emptyMessage(const Region& region) const {
    MessageBuffer message{kShareHeaderBytes};
    writeShareHeader({image_.area().bounds, region, {}}, A::kWireBytes,
                     message.bytes().template first<kShareHeaderBytes>());
    return message;
  }

  PartialImage<A> image_;
  Traffic traffic_;
  Outcome outcome_;
};

}  // namespace burin::compositor
