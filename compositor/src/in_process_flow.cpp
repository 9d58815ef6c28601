#include "burin/compositor/in_process_flow.hpp"

#include <algorithm>

namespace burin::compositor {

void Mailboxes::put(Rank sender, Rank receiver, Tag tag, std::span<const std::byte> message) {
  {
    const std::scoped_lock lock{mutex_};
    boxes_[{sender, receiver, tag}].push_back(message);
  }
  hasMail_.notify_all();
}

std::span<const std::byte> Mailboxes::take(Rank sender, Rank receiver, Tag tag) {
  std::unique_lock lock{mutex_};
  auto& box = boxes_[{sender, receiver, tag}];  // references into a map stay valid
  hasMail_.wait(lock, [&] { return !box.empty(); });
  const auto message = box.front();
  box.pop_front();
  return message;
}

void InProcessFlow::receiveEach(Tag tag, std::span<Received> messages, const Room& room,
                                const std::function<void(std::size_t)>& use) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const auto message = mailboxes_->take(messages[i].sender, self_, tag);
    const auto place = room(message.size());
    std::ranges::copy(message, place.begin());
    messages[i].bytes = place;
    use(i);
  }
}

}  // namespace burin::compositor
