#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace burin::compositor {

/// Bytes that are not cleared first: a receive buffer's unused end is never touched, so a sparse
/// message costs only its own memory.
class MessageBuffer {
 public:
  MessageBuffer() = default;
  explicit MessageBuffer(std::size_t size)
      : bytes_{std::make_unique_for_overwrite<std::byte[]>(size)}, size_{size} {}
  std::span<std::byte> bytes() { return {bytes_.get(), size_}; }
  std::span<const std::byte> bytes() const { return {bytes_.get(), size_}; }
  /// Gives the memory away.
  std::byte* release() { return bytes_.release(); }

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace burin::compositor
