#pragma once

#include <dlfcn.h>

#include <memory>

#include "burin/common/error.hpp"

namespace burin::node {

struct CloseLibrary {
  void operator()(void* handle) const noexcept { dlclose(handle); }
};
/// A library opened at run time.
using SharedLibrary = std::unique_ptr<void, CloseLibrary>;

/// Throws Error{kRank} if there is no such function. `libraryName`: for the message.
template <typename Function>
Function* resolve(const SharedLibrary& library, const char* libraryName, const char* name) {
  void* const symbol = dlsym(library.get(), name);
  if (symbol == nullptr) fail(ExitCode::kRank, "{} has no function {}", libraryName, name);
  return reinterpret_cast<Function*>(symbol);
}

}  // namespace burin::node
