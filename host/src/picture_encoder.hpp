#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace burin::host {

/// What a picture file is to hold, in OpenImageIO's words.
struct PictureToEncode {
  const char* format = nullptr;  ///< "png", "openexr"
  std::string name;              ///< the file's, for messages; the encoder writes no file
  int width = 0;
  int height = 0;
  int channels = 0;
  bool isFloat = false;          ///< else 8 bits
  const void* pixels = nullptr;  ///< rows top to bottom, interleaved
  std::vector<std::pair<std::string, std::variant<int, std::string>>> attributes;
};

struct EncodedPicture {
  std::vector<unsigned char> bytes;  ///< the whole file
  std::string error;                 ///< why there is none, else ""
};

/// The function of the module burin_pictures of the name kEncodePicture. The module alone
/// is linked with OpenImageIO, whose 250 libraries take 0.4 s of processor time and 110 MB to load:
/// only a process that writes pictures opens it.
using EncodePicture = void(const PictureToEncode& picture, EncodedPicture& encoded);
inline constexpr const char* kEncodePicture = "burinEncodePicture";
/// Likewise: OpenImageIO's version.
using PictureLibrary = const char*();
inline constexpr const char* kPictureLibrary = "burinPictureLibrary";

}  // namespace burin::host
