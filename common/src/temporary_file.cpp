#include "burin/common/temporary_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "burin/common/error.hpp"

namespace burin {

namespace fs = std::filesystem;

namespace {

constexpr int kMostAttempts = 1000;

/// A link is followed: it is the file behind it that gets replaced.
fs::path followed(const fs::path& target) {
  std::error_code ignored;
  if (!fs::is_symlink(target, ignored)) return target;
  const fs::path real = fs::weakly_canonical(target, ignored);
  return ignored ? target : real;
}

void checkTarget(const fs::path& target) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail(ExitCode::kUsage, "{}: cannot write here, it is not a regular file", target.string());
}

struct OpenFile {
  fs::path path;
  int descriptor;
};

/// Creates the first free ".NAME.PID-i.tmp".
OpenFile createBeside(const fs::path& target) {
  for (int i = 0; i < kMostAttempts; ++i) {
    fs::path path = target;
    path.replace_filename(fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), i));
    const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {std::move(path), descriptor};
    if (errno != EEXIST)
      fail(ExitCode::kUsage, "{}: cannot write here: {}", target.string(), systemText(errno));
  }
  fail(ExitCode::kUsage, "{}: cannot write here: no free temporary name", target.string());
}

[[noreturn]] void failWriting(const fs::path& target, int code) {
  fail(ExitCode::kRank, "{}: cannot be written whole: {}", target.string(), systemText(code));
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) : target_{followed(target)} {
  checkTarget(target_);
  OpenFile created = createBeside(target_);
  path_ = std::move(created.path);
  descriptor_ = created.descriptor;
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

void TemporaryFile::write(std::span<const std::byte> bytes) {
  BURIN_CHECK(descriptor_ >= 0);
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) failWriting(target_, written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void TemporaryFile::close() {
  // Some file systems tell only now that the disk is full.
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) failWriting(target_, errno);
}

void TemporaryFile::commit() {
  close();
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error) fail(ExitCode::kRank, "{}: cannot be written: {}", target_.string(), error.message());
  path_.clear();
}

void checkWritable(const fs::path& target) {
  const TemporaryFile probe{target};
}

void writeFile(const fs::path& target, std::span<const std::byte> bytes) {
  TemporaryFile file{target};
  file.write(bytes);
  file.commit();
}

void writeTextFile(const fs::path& target, std::string_view text) {
  writeFile(target, std::as_bytes(std::span{text}));
}

}  // namespace burin
