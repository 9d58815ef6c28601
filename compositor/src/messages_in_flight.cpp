#include "messages_in_flight.hpp"

#include "burin/common/error.hpp"

namespace burin::compositor {

MessagesInFlight::Message MessagesInFlight::Run::at(int index) const {
  Message message = first;
  message.sender += index * senderStep;
  message.block.front += index * blockStep;
  message.block.back += index * blockStep;
  return message;
}

std::optional<int> MessagesInFlight::Run::indexOf(int sender) const {
  const int distance = sender - first.sender;
  if (distance == 0) return 0;
  if (senderStep == 0 || distance % senderStep != 0) return std::nullopt;
  const int index = distance / senderStep;
  if (index < 0 || index >= count) return std::nullopt;
  return index;
}

bool MessagesInFlight::Run::extend(const Message& message) {
  const bool isLike = message.region == first.region && message.block.back - message.block.front ==
                                                            first.block.back - first.block.front;
  if (!isLike || message.sender == first.sender) return false;
  if (count == 1) {
    senderStep = message.sender - first.sender;
    blockStep = message.block.front - first.block.front;
  } else if (const Message next = at(count);
             message.sender != next.sender || message.block != next.block) {
    return false;
  }
  ++count;
  return true;
}

void MessagesInFlight::add(const Message& message) {
  if (!runs_.empty() && runs_.back().extend(message)) return;
  runs_.push_back({message});
}

std::size_t MessagesInFlight::findRun(int sender) const {
  std::size_t i = 0;
  while (i < runs_.size() && !runs_[i].indexOf(sender)) ++i;
  return i;
}

std::optional<Region> MessagesInFlight::regionFrom(int sender) const {
  const std::size_t i = findRun(sender);
  if (i == runs_.size()) return std::nullopt;
  return runs_[i].first.region;
}

MessagesInFlight::Message MessagesInFlight::take(int sender) {
  const std::size_t i = findRun(sender);
  BURIN_CHECK(i < runs_.size());
  Run& run = runs_[i];
  const int index = run.indexOf(sender).value();
  const Message taken = run.at(index);
  Run after = run;
  after.first = run.at(index + 1);
  after.count = run.count - index - 1;
  run.count = index;
  const auto place = runs_.begin() + static_cast<std::ptrdiff_t>(i);
  if (index == 0 && after.count == 0) {
    runs_.erase(place);
  } else if (index == 0) {
    run = after;
  } else if (after.count > 0) {
    runs_.insert(place + 1, after);
  }
  return taken;
}

}  // namespace burin::compositor
