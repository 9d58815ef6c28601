#include "file_handle.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::node {

FileHandle::FileHandle(std::filesystem::path path) : path_{std::move(path)} {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    fail(ExitCode::kVolume, "{}: cannot be opened: {}", path_.string(), systemText(errno));
  }
}

FileHandle::~FileHandle() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t FileHandle::readSome(std::uint64_t offset, std::span<std::byte> out) const {
  constexpr std::size_t kLargestRead = std::size_t{1} << 30;  // Linux stops short of 2 GiB a call
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t got =
        ::pread(descriptor_, out.data() + done, std::min(out.size() - done, kLargestRead),
                static_cast<off_t>(offset + done));
    if (got == 0) break;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      fail(ExitCode::kVolume, "{}: reading {} bytes at {} failed: {}", path_.string(), out.size(),
           offset, systemText(errno));
    }
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void FileHandle::readExactly(std::uint64_t offset, std::span<std::byte> out) const {
  const std::size_t got = readSome(offset, out);
  if (got != out.size()) {
    fail(ExitCode::kVolume, "{}: ended after {} bytes while being read (expected at least {})",
         path_.string(), offset + got, offset + out.size());
  }
}

void FileHandle::readPieces(std::uint64_t offset, std::size_t pieceBytes, std::size_t stride,
                            std::span<std::byte> out) const {
  // One call for many pieces; what lies between them goes where it stays in the cache. Linux takes
  // 1024 places a call.
  constexpr std::size_t kPiecesPerCall = 512;
  std::vector<std::byte> between(stride - pieceBytes);
  std::vector<iovec> places;
  for (std::size_t done = 0; done < out.size();) {
    const std::size_t pieces = std::min((out.size() - done) / pieceBytes, kPiecesPerCall);
    places.clear();
    for (std::size_t i = 0; i < pieces; ++i) {
      if (i > 0) places.push_back({between.data(), between.size()});
      places.push_back({out.data() + done + i * pieceBytes, pieceBytes});
    }
    const ssize_t got = ::preadv(descriptor_, places.data(), static_cast<int>(places.size()),
                                 static_cast<off_t>(offset));
    const bool isWhole = got == static_cast<ssize_t>((pieces - 1) * stride + pieceBytes);
    // Interrupted, or the file ends: piece by piece says which, and where.
    for (std::size_t i = 0; i < pieces && !isWhole; ++i)
      readExactly(offset + i * stride, out.subspan(done + i * pieceBytes, pieceBytes));
    done += pieces * pieceBytes;
    offset += pieces * stride;
  }
}

}  // namespace burin::node
