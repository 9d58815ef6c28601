#include "file_handle.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

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

}  // namespace burin::node
