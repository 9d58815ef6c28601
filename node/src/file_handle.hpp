#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

namespace burin::node {

/// A file open for reading at any offset. Move-only.
class FileHandle {
 public:
  /// Throws Error{kVolume} with the system's reason.
  explicit FileHandle(std::filesystem::path path);
  FileHandle(FileHandle&& other) noexcept
      : path_{std::move(other.path_)}, descriptor_{std::exchange(other.descriptor_, -1)} {}
  FileHandle& operator=(FileHandle&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileHandle();

  const std::filesystem::path& path() const { return path_; }

  /// Reads up to out.size() bytes at `offset`; fewer only at the end of the file.
  /// @returns the number of bytes read. Throws Error{kVolume} if the system cannot read.
  std::size_t readSome(std::uint64_t offset, std::span<std::byte> out) const;

  /// Reads exactly out.size() bytes. Throws Error{kVolume} if the file ends before.
  void readExactly(std::uint64_t offset, std::span<std::byte> out) const;

  /// Reads pieces of `pieceBytes` each, which begin `stride` (at least that) bytes apart in the
  /// file from `offset` on, into `out`, next to each other (a multiple of a piece). Throws
  /// Error{kVolume} if the file ends before.
  void readPieces(std::uint64_t offset, std::size_t pieceBytes, std::size_t stride,
                  std::span<std::byte> out) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace burin::node
