#include "picture_module.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "burin/common/error.hpp"

namespace burin::host {

namespace {

namespace fs = std::filesystem;

/// Beside the program, in the build tree as where it is installed.
fs::path moduleFile() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return (program.parent_path() / BURIN_PICTURES_MODULE).lexically_normal();
}

/// What dlopen or dlsym found.
void* checked(void* found) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
  if (found == nullptr) fail(ExitCode::kRank, "no pictures can be written: {}", dlerror());
  return found;
}

}  // namespace

void* pictureFunction(const char* name) {
  // Lazy, as programs are linked: binding every function of every library would take seconds. Never
  // closed: OpenImageIO has threads of its own.
  static void* const library = checked(dlopen(moduleFile().c_str(), RTLD_LAZY | RTLD_LOCAL));
  return checked(dlsym(library, name));
}

}  // namespace burin::host
