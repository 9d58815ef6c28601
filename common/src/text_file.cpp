#include "text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "burin/common/error.hpp"

namespace burin {

std::string readSmallFile(const std::filesystem::path& file, std::string_view what) {
  constexpr std::uintmax_t kLargestBytes = std::uintmax_t{16} << 20;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) fail(ExitCode::kUsage, "{}: cannot read {}: {}", file.string(), what, error.message());
  if (bytes > kLargestBytes) {
    fail(ExitCode::kUsage, "{}: {} bytes, too many for {}; expected at most {}", file.string(),
         bytes, what, kLargestBytes);
  }
  errno = 0;
  std::ifstream stream{file, std::ios::binary};
  std::string text{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream.is_open() || stream.bad())
    fail(ExitCode::kUsage, "{}: cannot read {}: {}", file.string(), what, std::strerror(errno));
  return text;
}

}  // namespace burin
