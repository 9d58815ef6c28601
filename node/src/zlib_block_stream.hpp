#pragma once

#include <memory>
#include <vector>

#include "byte_stream.hpp"

namespace burin::node {

/// Blocks that zlib compressed one by one, behind each other in another stream.
class ZlibBlockStream : public ByteStream {
 public:
  struct Block {
    std::uint64_t packed = 0;    ///< bytes
    std::uint64_t unpacked = 0;  ///< bytes
  };

  /// Throws Error{kVolume} if a block cannot be as large as it says.
  ZlibBlockStream(std::unique_ptr<ByteStream> packed, std::vector<Block> blocks);
  const std::filesystem::path& path() const override { return packed_->path(); }
  std::uint64_t position() const override { return position_; }
  void restart() override;
  std::size_t readSome(std::span<std::byte> out) override;
  std::uint64_t mostBytes() const override;

 private:
  void unpack(const Block& block);

  std::unique_ptr<ByteStream> packed_;
  std::vector<Block> blocks_;
  std::size_t next_ = 0;
  std::uint64_t position_ = 0;
  std::vector<std::byte> block_;  ///< unpacked, of which blockUsed_ bytes are delivered
  std::size_t blockUsed_ = 0;
};

}  // namespace burin::node
