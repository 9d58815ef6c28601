// Preloaded into the program by failing_program_test: temporary files take no bytes, as on a full
// disk.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

/// Of burin's: ".NAME.PID-i.tmp". Mesa's cache of shaders has other ones.
bool isTemporaryFile(int descriptor) {
  char link[64];
  char path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path);
  if (length <= 0) return false;
  const std::string_view file{path, static_cast<std::size_t>(length)};
  return file.ends_with(".tmp") && file.substr(file.find_last_of('/') + 1).starts_with('.');
}

}  // namespace

extern "C" ssize_t write(int descriptor, const void* bytes, size_t count) {
  const char* const largest = std::getenv("BURIN_LARGEST_FILE");
  if (isTemporaryFile(descriptor) && largest != nullptr) {
    const rlimit limit{std::strtoul(largest, nullptr, 10), RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);  // not before: MPI makes files of its own
  } else if (isTemporaryFile(descriptor)) {
    errno = ENOSPC;
    return -1;
  }
  return syscall(SYS_write, descriptor, bytes, count);
}
