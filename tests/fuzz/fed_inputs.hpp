#pragma once

#include <span>
#include <string>

namespace burin::test {

/// A kind of file that users hand us, and what reads it.
struct FedInput {
  const char* name;       ///< "nrrd": of the fuzz target and of its seeds' folder
  const char* extension;  ///< of files that are such; a file's last, ".gz" aside
  void (*read)(const std::string& file);
};

/// Every kind whose reader is ours or says something to a library.
std::span<const FedInput> fedInputs();

/// Reads `file` as `input`, whatever is in it. @returns why it was refused; empty if it was not.
/// Throws std::logic_error if it was refused in another way than files are: on one line, as a bad
/// volume or as bad use.
std::string feed(const FedInput& input, const std::string& file);

}  // namespace burin::test
