#include "dicom_folder.hpp"

#include <array>

#include "burin/common/error.hpp"
#include "file_handle.hpp"

namespace burin::node {

namespace fs = std::filesystem;

void forFilesBelow(const fs::path& folder, const std::function<bool(const fs::path&)>& visit) {
  std::error_code error;
  for (fs::recursive_directory_iterator at{folder, error}, end; at != end; at.increment(error)) {
    if (error) break;
    std::error_code ignored;
    if (at->is_regular_file(ignored) && !visit(at->path())) return;
  }
  if (error) fail(ExitCode::kVolume, "{}: {}", folder.string(), error.message());
}

bool hasDicomFiles(const fs::path& folder) {
  bool found = false;
  forFilesBelow(folder, [&](const fs::path& file) {
    std::array<std::byte, 4> magic{};
    FileHandle{file}.readSome(128, magic);
    found = magic == std::array{std::byte{'D'}, std::byte{'I'}, std::byte{'C'}, std::byte{'M'}};
    return !found;
  });
  return found;
}

}  // namespace burin::node
