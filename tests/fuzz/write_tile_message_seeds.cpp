#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "tile_messages.hpp"

/// write_tile_message_seeds FOLDER: makes the folder and writes a file per seed; the build runs it.
int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: write_tile_message_seeds FOLDER\n", stderr);
    return 2;
  }
  const std::filesystem::path folder{argv[1]};
  std::filesystem::create_directories(folder);
  for (const auto& seed : burin::compositor::fuzz::tileMessageSeeds()) {
    std::ofstream file{folder / seed.name, std::ios::binary};
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.write(reinterpret_cast<const char*>(seed.bytes.data()),
               static_cast<std::streamsize>(seed.bytes.size()));
    file.close();
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "write_tile_message_seeds: %s\n", e.what());
  return 1;
}
