#include "picture_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "burin/common/error.hpp"
#include "file_formats.hpp"
#include "number_pattern.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

namespace fs = std::filesystem;

/// The last number in a file's name, what stands before it and behind it.
struct NumberedName {
  std::string before, after;
  long number = 0;
};

std::optional<NumberedName> numberedName(const std::string& name) {
  const std::size_t end = name.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const auto number = numberIn<long>(std::string_view{name}.substr(begin, end + 1 - begin));
  if (!number) return std::nullopt;
  return NumberedName{name.substr(0, begin), name.substr(end + 1), *number};
}

/// Numbered files by number. Throws Error{kVolume} if one is missing in between.
std::vector<fs::path> inOrder(const std::string& name, const std::map<long, fs::path>& numbered) {
  std::vector<fs::path> files;
  long next = numbered.empty() ? 0 : numbered.begin()->first;
  for (const auto& [number, file] : numbered) {
    if (number != next) {
      fail(ExitCode::kVolume, "{}: number {} is missing before {}", name, next,
           file.filename().string());
    }
    files.push_back(file);
    ++next;
  }
  return files;
}

/// The files that fit "slice%03d.png".
std::vector<fs::path> picturesLike(const fs::path& written) {
  const auto pattern = parseNumberPattern(written.filename().string());
  const fs::path folder = written.has_parent_path() ? written.parent_path() : ".";
  std::map<long, fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{folder, error}) {
    const std::string name = entry.path().filename().string();
    const auto numbered = numberedName(name);
    if (numbered && name == pattern->name(numbered->number)) found[numbered->number] = entry.path();
  }
  if (error) fail(ExitCode::kVolume, "{}: {}", folder.string(), error.message());
  if (found.empty()) fail(ExitCode::kVolume, "{}: no such files", written.string());
  return inOrder(written.string(), found);
}

}  // namespace

bool isPictureName(const std::string& name) {
  constexpr std::string_view kExtensions[] = {".tif",  ".tiff", ".png", ".jpg",
                                              ".jpeg", ".bmp",  ".pgm", ".exr"};
  std::string extension = fs::path{name}.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kExtensions, extension) != std::end(kExtensions);
}

std::vector<fs::path> picturesIn(const fs::path& folder) {
  std::map<std::pair<std::string, std::string>, std::map<long, fs::path>> sequences;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{folder, error}) {
    const std::string name = entry.path().filename().string();
    const auto numbered = isPictureName(name) ? numberedName(name) : std::nullopt;
    if (numbered) sequences[{numbered->before, numbered->after}][numbered->number] = entry.path();
  }
  if (error) fail(ExitCode::kVolume, "{}: {}", folder.string(), error.message());
  if (sequences.size() > 1) {
    std::string list;
    for (const auto& [name, files] : sequences)
      list += fmt::format("{}{}%d{} ({})", list.empty() ? "" : ", ", name.first, name.second,
                          files.size());
    fail(ExitCode::kVolume, "{}: {} sequences of pictures (expected one, or its name): {}",
         folder.string(), sequences.size(), list);
  }
  if (sequences.empty()) return {};
  return inOrder(folder.string(), sequences.begin()->second);
}

bool isPicturePattern(const std::string& written) {
  const fs::path path{written};
  std::error_code ignored;
  return parseNumberPattern(path.filename().string()).has_value() &&
         isPictureName(path.filename().string()) && !fs::exists(path, ignored);
}

std::vector<fs::path> pictureFiles(const std::string& written) {
  if (isPicturePattern(written)) return picturesLike(written);
  std::error_code ignored;
  if (fs::is_directory(written, ignored)) return picturesIn(written);
  return {written};
}

}  // namespace burin::node
