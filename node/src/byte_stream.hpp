#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace burin::node {

/// Bytes of a file, decoded on their way; forward only, `restart` begins again.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  virtual const std::filesystem::path& path() const = 0;

  /// Bytes delivered so far.
  virtual std::uint64_t position() const = 0;

  virtual void restart() = 0;

  /// Up to out.size() bytes; fewer only at the stream's end. Throws Error{kVolume} if the stream is
  /// damaged or ends early.
  virtual std::size_t readSome(std::span<std::byte> out) = 0;

  /// What it can deliver at most, by the size of the file alone: a header that promises more lies.
  virtual std::uint64_t mostBytes() const = 0;
};

}  // namespace burin::node
