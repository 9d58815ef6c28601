#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace burin::node {

/// Numbers of one page of a picture file.
struct PageShape {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::string type;  ///< as StoredType is called, "u16"; or OpenImageIO's word for any other
};

/// A file of pictures, read by OpenImageIO. That library brings 250 others, whose relocations take
/// half a second of every process, so it is in a module that is opened where pictures are read;
/// this is all that the rest of the program knows of it.
class PictureFile {
 public:
  virtual ~PictureFile() = default;
  virtual std::string format() const = 0;
  virtual int pages() = 0;
  virtual PageShape shape(int page) = 0;

  /// An attribute of the first page; empty, or 0, if it is not there.
  virtual std::string text(const std::string& attribute) = 0;
  virtual double number(const std::string& attribute) = 0;

  /// A page in its own type, native byte order, channels together; `out` has exactly its size.
  /// @returns why that failed, empty if it did not.
  virtual std::string read(int page, std::span<std::byte> out) = 0;
};

/// The module's one function, by that name: the file, or null and the reason. The caller owns it.
using OpenPictureFile = PictureFile*(const std::string& file, std::string& reason);
inline constexpr const char* kOpenPictureFile = "burinOpenPictureFile";

}  // namespace burin::node
