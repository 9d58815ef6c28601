#pragma once

#include <string>

namespace burin::node {

/// "file.h5" and "/path" of what the user wrote; the path is empty if there is none.
struct Hdf5Name {
  std::string file;
  std::string path;
};

Hdf5Name splitHdf5Name(const std::string& written);

}  // namespace burin::node
