#pragma once

#include <string>

namespace burin::node {

/// A function of a module that lies beside the program, at `module` relative to the program's
/// folder, in the build tree as where it is installed. The module stays open. Throws Error{kRank}.
void* moduleFunction(const std::string& module, const char* function);

}  // namespace burin::node
