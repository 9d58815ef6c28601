#include "burin/compositor/frame_memory.hpp"

#include <algorithm>
#include <cstdint>

namespace burin::compositor {

namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kSmallestBlock = std::size_t{1} << 20;

constexpr std::size_t roundedUp(std::size_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

/// The part of `bytes` that begins at a multiple of the alignment.
std::span<std::byte> aligned(std::span<std::byte> bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  return bytes.subspan(std::min(bytes.size(), roundedUp(address) - address));
}

}  // namespace

std::byte* FrameMemory::take(std::size_t bytes) {
  const std::size_t wanted = roundedUp(bytes);
  for (;; ++current_, used_ = 0) {
    if (current_ > blocks_.size()) {
      const std::size_t size = std::max(kSmallestBlock, wanted) + kAlignment;
      blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size});
    }
    const std::span<std::byte> place = aligned(
        current_ == 0 ? first_
                      : std::span{blocks_[current_ - 1].bytes.get(), blocks_[current_ - 1].size});
    if (place.size() < wanted || place.size() - wanted < used_) continue;
    std::byte* const begin = place.data() + used_;
    used_ += wanted;
    return begin;
  }
}

void FrameMemory::giveBack(std::size_t last, std::size_t used) {
  used_ -= roundedUp(last) - roundedUp(used);
}

std::size_t FrameMemory::heapBytes() const {
  std::size_t total = 0;
  for (const Block& block : blocks_) total += block.size;
  return total;
}

void FrameMemory::reset() {
  // One block instead of many, else every frame that needs a little more would leave one behind.
  if (blocks_.size() > 1) {
    const std::size_t total = heapBytes();
    blocks_.clear();
    blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(total), total});
  }
  current_ = 0;
  used_ = 0;
}

}  // namespace burin::compositor
