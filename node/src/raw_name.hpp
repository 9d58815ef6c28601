#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace burin::node {

/// What a raw file's name says in the form of the Open SciVis Datasets: name_XxYxZ_type.raw, e.g.
/// "bonsai_256x256x256_uint8.raw".
struct RawName {
  glm::ivec3 dims;
  std::string type;  ///< as written: "uint8"
};

/// From a file name without folders. Nothing if the name does not have that form.
std::optional<RawName> parseRawName(std::string_view fileName);

/// Our name ("u8") of a type as the user or a file name writes it ("uint8", "float", "u8"); nothing
/// if it is unknown or not supported.
std::optional<std::string_view> canonicalTypeName(std::string_view written);

}  // namespace burin::node
