#include "hdf5_name.hpp"

#include <filesystem>

namespace burin::node {

Hdf5Name splitHdf5Name(const std::string& written) {
  const std::size_t colon = written.rfind(":/");
  std::error_code ignored;
  if (colon == std::string::npos || std::filesystem::exists(written, ignored)) return {written, ""};
  return {written.substr(0, colon), written.substr(colon + 1)};
}

}  // namespace burin::node
