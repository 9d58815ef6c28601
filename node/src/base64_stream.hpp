#pragma once

#include <vector>

#include "byte_stream.hpp"
#include "file_handle.hpp"

namespace burin::node {

/// Base64 text in a file, decoded (RFC 4648, section 4). White space does not count; padding or any
/// other character ends it.
class Base64Stream : public ByteStream {
 public:
  Base64Stream(FileHandle file, std::uint64_t fileOffset);
  const std::filesystem::path& path() const override { return file_.path(); }
  std::uint64_t position() const override { return position_; }
  void restart() override;
  std::size_t readSome(std::span<std::byte> out) override;
  std::uint64_t mostBytes() const override;

 private:
  int nextSextet();
  bool decodeQuad();

  FileHandle file_;
  std::uint64_t fileStart_;
  std::uint64_t fileNext_;
  std::uint64_t position_ = 0;
  std::vector<std::byte> text_;
  std::size_t textUsed_ = 0;
  std::byte decoded_[3]{};
  std::size_t decodedUsed_ = 0;
  std::size_t decodedCount_ = 0;
  bool ended_ = false;
};

/// Characters that `bytes` bytes take, with padding.
constexpr std::uint64_t base64Characters(std::uint64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

}  // namespace burin::node
