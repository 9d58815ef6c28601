#pragma once

#include <memory>
#include <vector>

#include "byte_stream.hpp"
#include "file_handle.hpp"

namespace burin::node {

/// What stands around deflated data.
enum class DeflateWrapper {
  kGzip,        ///< several gzip members one after another are one stream, as gzip(1) has it
  kZlibOrGzip,  ///< either, as the first bytes say; one member, what follows it is not looked at
};

/// Inflates what a file holds from an offset on.
class GzipStream : public ByteStream {
 public:
  /// `fileOffset`: bytes of the file before the stream.
  GzipStream(FileHandle file, std::uint64_t fileOffset,
             DeflateWrapper wrapper = DeflateWrapper::kGzip);
  ~GzipStream() override;
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  const std::filesystem::path& path() const override { return file_.path(); }
  std::uint64_t position() const override { return position_; }
  void restart() override;

  /// The end is checked: length and check sum, and of gzip that nothing stands behind it.
  std::size_t readSome(std::span<std::byte> out) override;
  std::uint64_t mostBytes() const override;

 private:
  struct Inflater;
  void refill();
  void inflateSome();
  bool nextMember();

  FileHandle file_;
  DeflateWrapper wrapper_;
  std::uint64_t fileStart_;
  std::uint64_t fileNext_;  ///< where the next refill reads
  std::uint64_t position_ = 0;
  bool ended_ = false;
  std::vector<std::byte> input_;
  std::unique_ptr<Inflater> inflater_;
};

/// What deflated data of this size can inflate to at most, and a little more.
std::uint64_t mostInflated(std::uint64_t deflatedBytes);

}  // namespace burin::node
