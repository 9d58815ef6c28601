#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace burin {

/// A file written front to back under a temporary name beside its final one, which it gets only
/// when it is whole. Removed on destruction unless committed, so that no failure leaves anything
/// behind.
class TemporaryFile {
 public:
  /// Creates the empty file. Throws Error{kUsage} if the folder is missing or not writable, or if
  /// `target` is something else than a regular file.
  explicit TemporaryFile(const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Appends. Throws Error{kRank} if the system cannot write, as on a full disk.
  void write(std::span<const std::byte> bytes);
  /// Ends the writing; the file keeps its temporary name. Throws as `write` does.
  void close();
  /// `close`, then the final name. Throws Error{kRank} if the system refuses.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;  ///< empty once committed
  int descriptor_ = -1;         ///< -1 once closed
};

/// Throws Error{kUsage} unless a file can be written there. Leaves nothing behind.
void checkWritable(const std::filesystem::path& target);

/// Writes a file as a whole or not at all. Throws as TemporaryFile does.
void writeFile(const std::filesystem::path& target, std::span<const std::byte> bytes);
void writeTextFile(const std::filesystem::path& target, std::string_view text);

}  // namespace burin
