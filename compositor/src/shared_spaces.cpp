#include "burin/compositor/shared_spaces.hpp"

#include <functional>

namespace burin::compositor {

std::optional<SharedPlace> SharedSpaces::find(std::span<const std::byte> bytes) const {
  const std::less_equal<> isNotBehind;  // a total order also between different memories
  for (std::size_t rank = 0; rank < byRank_.size(); ++rank) {
    const auto space = byRank_[rank];
    if (space.empty() || !isNotBehind(space.data(), bytes.data()) ||
        !isNotBehind(bytes.data() + bytes.size(), space.data() + space.size())) {
      continue;
    }
    return SharedPlace{static_cast<std::int32_t>(rank),
                       static_cast<std::uint64_t>(bytes.data() - space.data())};
  }
  return std::nullopt;
}

std::optional<std::span<const std::byte>> SharedSpaces::at(SharedPlace place,
                                                           std::size_t bytes) const {
  const auto space = of(place.rank);
  if (space.empty() || place.offset > space.size() || bytes > space.size() - place.offset) {
    return std::nullopt;
  }
  return space.subspan(static_cast<std::size_t>(place.offset), bytes);
}

}  // namespace burin::compositor
