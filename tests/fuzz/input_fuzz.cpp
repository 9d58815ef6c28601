// A fuzz target for each of fedInputs(): the program's name says which, "nrrd_fuzz".
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fed_inputs.hpp"

namespace {

namespace fs = std::filesystem;

const burin::test::FedInput* chosen = nullptr;
fs::path fedFile;  ///< in memory, if the machine has /dev/shm

void removeFile() {
  std::error_code ignored;
  fs::remove(fedFile, ignored);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** argv) {
  const std::string program = fs::path{(*argv)[0]}.filename().string();
  for (const auto& input : burin::test::fedInputs()) {
    if (program == std::string{input.name} + "_fuzz") chosen = &input;
  }
  if (chosen == nullptr) {
    std::fprintf(stderr, "%s: expected a link named as an input, nrrd_fuzz\n", program.c_str());
    std::exit(2);
  }
  const fs::path memory{"/dev/shm"};
  const fs::path folder = fs::is_directory(memory) ? memory : fs::temp_directory_path();
  fedFile = folder / ("burin-fuzz-" + std::to_string(getpid()) + chosen->extension);
  std::atexit(removeFile);
  return 0;
}

/// What libFuzzer calls, again and again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream{fedFile, std::ios::binary}.write(reinterpret_cast<const char*>(data),
                                                 static_cast<std::streamsize>(size));
  burin::test::feed(*chosen, fedFile.string());
  return 0;
}
