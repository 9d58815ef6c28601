#include "gzip_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "burin/common/error.hpp"
#include "stored_voxels.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kInputBytes = std::size_t{256} << 10;
constexpr int kGzipWindow = 15 + 16;        // the largest window, gzip header and trailer required
constexpr int kZlibOrGzipWindow = 15 + 32;  // either header
constexpr Bytef kMagic[2] = {0x1f, 0x8b};

const char* wrapperName(DeflateWrapper wrapper) {
  return wrapper == DeflateWrapper::kGzip ? "gzip" : "zlib";
}

}  // namespace

std::uint64_t mostInflated(std::uint64_t deflatedBytes) {
  // Deflate codes 258 bytes with 2 bits at best: 1032 to 1. The slack leaves streams that are
  // broken or empty to the better messages of the inflater.
  constexpr std::uint64_t kLargestRatio = 1032;
  constexpr std::uint64_t kSlack = std::uint64_t{1} << 16;
  return kLargestRatio * deflatedBytes + kSlack;
}

struct GzipStream::Inflater {
  z_stream z{};
  explicit Inflater(int window) {
    if (inflateInit2(&z, window) != Z_OK) fail(ExitCode::kRank, "zlib cannot be initialised");
  }
  ~Inflater() { inflateEnd(&z); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

GzipStream::GzipStream(FileHandle file, std::uint64_t fileOffset, DeflateWrapper wrapper)
    : file_{std::move(file)},
      wrapper_{wrapper},
      fileStart_{fileOffset},
      fileNext_{fileOffset},
      input_(kInputBytes),
      inflater_{std::make_unique<Inflater>(wrapper == DeflateWrapper::kGzip ? kGzipWindow
                                                                            : kZlibOrGzipWindow)} {}

GzipStream::~GzipStream() = default;

void GzipStream::restart() {
  inflateReset(&inflater_->z);
  inflater_->z.avail_in = 0;
  fileNext_ = fileStart_;
  position_ = 0;
  ended_ = false;
}

std::uint64_t GzipStream::mostBytes() const {
  const std::uint64_t fileBytes = regularFileSize(path());
  return mostInflated(fileBytes - std::min(fileBytes, fileStart_));
}

/// Puts unread input to the front and fills up behind it; leaves the input as it is at the file's
/// end.
void GzipStream::refill() {
  z_stream& z = inflater_->z;
  const std::size_t left = z.avail_in;
  if (left > 0) std::copy_n(z.next_in, left, reinterpret_cast<Bytef*>(input_.data()));
  const std::size_t got = file_.readSome(fileNext_, std::span{input_}.subspan(left));
  fileNext_ += got;
  z.next_in = reinterpret_cast<Bytef*>(input_.data());
  z.avail_in = static_cast<uInt>(left + got);
}

std::size_t GzipStream::readSome(std::span<std::byte> out) {
  z_stream& z = inflater_->z;
  std::size_t done = 0;
  while (done < out.size() && !ended_) {
    const auto piece = static_cast<uInt>(
        std::min<std::size_t>(out.size() - done, std::numeric_limits<uInt>::max() / 2));
    z.next_out = reinterpret_cast<Bytef*>(out.data() + done);
    z.avail_out = piece;
    inflateSome();
    const std::size_t got = piece - z.avail_out;
    done += got;
    position_ += got;
  }
  return done;
}

/// One call of inflate into the output that is set up, with input at hand.
void GzipStream::inflateSome() {
  z_stream& z = inflater_->z;
  if (z.avail_in == 0) refill();
  if (z.avail_in == 0) {
    fail(ExitCode::kVolume, "{}: the {} stream ends early, after {} inflated bytes",
         path().string(), wrapperName(wrapper_), position_);
  }
  const int result = inflate(&z, Z_NO_FLUSH);
  if (result == Z_STREAM_END) {
    ended_ = !nextMember();
  } else if (result != Z_OK && result != Z_BUF_ERROR) {
    fail(ExitCode::kVolume, "{}: the {} stream is damaged near file offset {}: {}", path().string(),
         wrapperName(wrapper_), fileNext_ - z.avail_in, z.msg != nullptr ? z.msg : zError(result));
  }
}

/// At the end of a member: true if another one follows, false at the end of the file.
bool GzipStream::nextMember() {
  if (wrapper_ == DeflateWrapper::kZlibOrGzip) return false;
  z_stream& z = inflater_->z;
  if (z.avail_in < sizeof kMagic) refill();
  if (z.avail_in == 0) return false;
  if (z.avail_in < sizeof kMagic || !std::equal(kMagic, kMagic + sizeof kMagic, z.next_in)) {
    fail(ExitCode::kVolume, "{}: bytes that are not gzip follow the gzip stream at file offset {}",
         path().string(), fileNext_ - z.avail_in);
  }
  inflateReset(&z);
  return true;
}

}  // namespace burin::node
