#pragma once

#include <string>
#include <vector>

#include "byte_stream.hpp"
#include "file_handle.hpp"
#include "stored_type.hpp"

namespace burin::node {

/// Numbers written as text, with white space between them, delivered as the bytes of their type in
/// native order. Ends after as many as were announced.
class TextStream : public ByteStream {
 public:
  /// `fileOffset`: bytes of the file before the text; `count`: numbers expected.
  TextStream(FileHandle file, std::uint64_t fileOffset, StoredType type, std::uint64_t count);

  const std::filesystem::path& path() const override { return file_.path(); }
  std::uint64_t position() const override { return position_; }
  void restart() override;

  /// Throws Error{kVolume} at a word that is no number of the type, or if there are too few. `out`
  /// takes whole numbers, unless it is behind the last one.
  std::size_t readSome(std::span<std::byte> out) override;
  std::uint64_t mostBytes() const override;

 private:
  std::string_view nextWord();
  bool refill();
  void decode(std::string_view word, std::byte* out) const;

  FileHandle file_;
  std::uint64_t fileStart_;
  std::uint64_t fileNext_;
  StoredType type_;
  std::uint64_t bytes_;  ///< of all numbers
  std::uint64_t position_ = 0;
  std::string text_;  ///< read from the file, of which the first `used_` characters are done
  std::size_t used_ = 0;
};

}  // namespace burin::node
