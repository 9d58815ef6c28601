#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace burin::compositor {

/// Memory for one frame's pixels and messages: handed out piece after piece, taken back all at
/// once, kept from frame to frame so that no page is cleared and faulted in again. Comes first from
/// a given span, which may be shared with other processes, then from the heap. Not cleared.
class FrameMemory {
 public:
  FrameMemory() = default;
  /// `first` must outlive this object.
  explicit FrameMemory(std::span<std::byte> first) : first_{first} {}
  FrameMemory(FrameMemory&&) noexcept = default;
  FrameMemory& operator=(FrameMemory&&) noexcept = default;

  /// `count` objects, aligned to a cache line, valid until reset(). Throws std::bad_alloc.
  template <typename T>
  requires std::is_trivially_copyable_v<T> std::span<T> allocate(std::size_t count) {
    return {reinterpret_cast<T*>(take(count * sizeof(T))), count};
  }
  /// Gives back the end of the allocation made last, of which `used` objects stay.
  template <typename T>
  std::span<T> keepFirst(std::span<T> last, std::size_t used) {
    giveBack(last.size_bytes(), used * sizeof(T));
    return last.first(used);
  }
  /// Everything handed out so far is free again.
  void reset();
  /// What it holds of the heap.
  std::size_t heapBytes() const;

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };
  std::byte* take(std::size_t bytes);
  void giveBack(std::size_t last, std::size_t used);

  std::span<std::byte> first_;
  std::vector<Block> blocks_;
  std::size_t current_ = 0;  ///< 0: the given span, else blocks_[current_ - 1]
  std::size_t used_ = 0;     ///< bytes of the current one, a multiple of the alignment
};

}  // namespace burin::compositor
