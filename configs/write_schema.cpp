// Writes the JSON schema of scene files to the file named by the one argument.
#include <cstdio>
#include <fstream>

#include "burin/common/scene.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: burin_write_schema FILE\n", stderr);
    return 2;
  }
  std::ofstream file{arguments[1], std::ios::binary};
  file << burin::sceneSchemaJson();
  file.close();
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", arguments[1]);
    return 1;
  }
  return 0;
}
