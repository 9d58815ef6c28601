#include "module_function.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "burin/common/error.hpp"

namespace burin::node {

void* moduleFunction(const std::string& module, const char* function) {
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto file = (program.parent_path() / module).lexically_normal();
  // Lazy, as programs are linked: binding every function of every library would take seconds.
  void* const library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const found = library == nullptr ? nullptr : dlsym(library, function);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
  if (found == nullptr) fail(ExitCode::kRank, "such files cannot be read: {}", dlerror());
  return found;
}

}  // namespace burin::node
