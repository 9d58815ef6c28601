#pragma once

#include <utility>

#include "byte_stream.hpp"
#include "file_handle.hpp"
#include "stored_voxels.hpp"

namespace burin::node {

/// The bytes of a file from an offset on, as they are.
class FileStream : public ByteStream {
 public:
  FileStream(FileHandle file, std::uint64_t fileOffset)
      : file_{std::move(file)}, fileStart_{fileOffset} {}
  const std::filesystem::path& path() const override { return file_.path(); }
  std::uint64_t position() const override { return position_; }
  void restart() override { position_ = 0; }
  std::size_t readSome(std::span<std::byte> out) override {
    const std::size_t got = file_.readSome(fileStart_ + position_, out);
    position_ += got;
    return got;
  }
  std::uint64_t mostBytes() const override {
    const std::uint64_t fileBytes = regularFileSize(path());
    return fileBytes - std::min(fileBytes, fileStart_);
  }

 private:
  FileHandle file_;
  std::uint64_t fileStart_;
  std::uint64_t position_ = 0;
};

}  // namespace burin::node
