#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "file_handle.hpp"

namespace burin::node {

/// Inflates a gzip stream inside a file, forward only; `restart` begins again. Several gzip members
/// one after another are one stream, as gzip(1) has it.
class GzipStream {
 public:
  /// `fileOffset`: bytes of the file before the stream.
  GzipStream(FileHandle file, std::uint64_t fileOffset);
  ~GzipStream();
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  const std::filesystem::path& path() const { return file_.path(); }
  std::uint64_t position() const { return position_; }  ///< inflated bytes delivered so far

  void restart();

  /// Up to out.size() inflated bytes; fewer only at the stream's end, which is checked (length and
  /// check sum, nothing behind it). Throws Error{kVolume} if the stream is damaged or ends early.
  std::size_t readSome(std::span<std::byte> out);

 private:
  struct Inflater;
  void refill();
  void inflateSome();
  bool nextMember();

  FileHandle file_;
  std::uint64_t fileStart_;
  std::uint64_t fileNext_;  ///< where the next refill reads
  std::uint64_t position_ = 0;
  bool ended_ = false;
  std::vector<std::byte> input_;
  std::unique_ptr<Inflater> inflater_;
};

}  // namespace burin::node
