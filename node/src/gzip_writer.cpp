#include "gzip_writer.hpp"

#define ZLIB_CONST  // zlib's pointer to its input is one to const
#include <zlib.h>

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kOutputBytes = std::size_t{256} << 10;
constexpr int kGzipWindow = 15 + 16;  // the largest window, gzip header and trailer
constexpr int kMemoryLevel = 8;       // zlib's default

}  // namespace

struct GzipWriter::Deflater {
  z_stream z{};
  Deflater() {
    if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK)
      fail(ExitCode::kRank, "zlib cannot be initialised");
  }
  ~Deflater() { deflateEnd(&z); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
};

GzipWriter::GzipWriter(TemporaryFile& file)
    : file_{file}, output_(kOutputBytes), deflater_{std::make_unique<Deflater>()} {}

GzipWriter::~GzipWriter() = default;

void GzipWriter::write(std::span<const std::byte> bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 30;  // zlib counts in unsigned
  while (!bytes.empty()) {
    const std::size_t piece = std::min(bytes.size(), kMost);
    deflateAll(bytes.first(piece), Z_NO_FLUSH);
    bytes = bytes.subspan(piece);
  }
}

void GzipWriter::finish() {
  deflateAll({}, Z_FINISH);
}

/// All of `bytes` into the stream; what of it is ready, into the file.
void GzipWriter::deflateAll(std::span<const std::byte> bytes, int flush) {
  z_stream& z = deflater_->z;
  z.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  z.avail_in = static_cast<uInt>(bytes.size());
  do {
    z.next_out = reinterpret_cast<Bytef*>(output_.data());
    z.avail_out = static_cast<uInt>(output_.size());
    BURIN_CHECK(deflate(&z, flush) != Z_STREAM_ERROR);
    file_.write(std::span{output_}.first(output_.size() - z.avail_out));
  } while (z.avail_out == 0);  // a full buffer: there may be more
}

}  // namespace burin::node
