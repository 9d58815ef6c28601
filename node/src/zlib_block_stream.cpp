#include "zlib_block_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <utility>

#include "burin/common/error.hpp"
#include "gzip_stream.hpp"

namespace burin::node {

ZlibBlockStream::ZlibBlockStream(std::unique_ptr<ByteStream> packed, std::vector<Block> blocks)
    : packed_{std::move(packed)}, blocks_{std::move(blocks)} {
  const std::uint64_t most = packed_->mostBytes();
  std::uint64_t all = 0;
  for (const Block& block : blocks_) {
    if (block.packed > most - all || block.unpacked > mostInflated(block.packed)) {
      fail(ExitCode::kVolume,
           "{}: truncated, or a damaged header: a block of {} compressed bytes for {} (expected at "
           "most {} bytes of them in the file)",
           path().string(), block.packed, block.unpacked, most - all);
    }
    all += block.packed;
  }
}

void ZlibBlockStream::restart() {
  packed_->restart();
  next_ = 0;
  position_ = 0;
  block_.clear();
  blockUsed_ = 0;
}

std::uint64_t ZlibBlockStream::mostBytes() const {
  std::uint64_t sum = 0;
  for (const Block& block : blocks_) sum += block.unpacked;
  return sum;
}

void ZlibBlockStream::unpack(const Block& block) {
  std::vector<std::byte> packed(static_cast<std::size_t>(block.packed));
  if (packed_->readSome(packed) != packed.size()) {
    fail(ExitCode::kVolume, "{}: compressed block {} of {} ends early", path().string(), next_ + 1,
         blocks_.size());
  }
  block_.resize(static_cast<std::size_t>(block.unpacked));
  uLongf got = block_.size();
  const int result = uncompress(reinterpret_cast<Bytef*>(block_.data()), &got,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (result != Z_OK || got != block_.size()) {
    fail(ExitCode::kVolume, "{}: compressed block {} of {} is damaged ({}; {} bytes, {} expected)",
         path().string(), next_ + 1, blocks_.size(), zError(result), got, block.unpacked);
  }
  blockUsed_ = 0;
}

std::size_t ZlibBlockStream::readSome(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size()) {
    if (blockUsed_ == block_.size()) {
      if (next_ == blocks_.size()) break;
      unpack(blocks_[next_]);
      ++next_;
    }
    const std::size_t piece = std::min(out.size() - done, block_.size() - blockUsed_);
    std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(blockUsed_), piece,
                out.begin() + static_cast<std::ptrdiff_t>(done));
    blockUsed_ += piece;
    done += piece;
  }
  position_ += done;
  return done;
}

}  // namespace burin::node
