#include "bench/output_folder.hpp"

#include <cctype>
#include <string>
#include <system_error>

#include "burin/common/error.hpp"
#include "burin/common/temporary_file.hpp"

namespace burin::host::bench {

void createOutputFolder(const std::filesystem::path& folder, std::string_view table) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(ExitCode::kUsage, "--out {}: {}", folder.string(), error.message());
  checkWritable(folder / table);
}

std::string tableName(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
  }
  return name;
}

}  // namespace burin::host::bench
