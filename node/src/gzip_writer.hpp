#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "burin/common/temporary_file.hpp"

namespace burin::node {

/// Appends one gzip stream to a file, from wherever that is when the writer is made.
class GzipWriter {
 public:
  /// `file` outlives the writer.
  explicit GzipWriter(TemporaryFile& file);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  /// Throws as TemporaryFile::write does.
  void write(std::span<const std::byte> bytes);
  /// Ends the stream: the last call. Throws as `write` does.
  void finish();

 private:
  struct Deflater;
  void deflateAll(std::span<const std::byte> bytes, int flush);

  TemporaryFile& file_;
  std::vector<std::byte> output_;
  std::unique_ptr<Deflater> deflater_;
};

}  // namespace burin::node
