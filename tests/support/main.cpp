// GoogleTest's main for programs of one process.

#include <gtest/gtest.h>

#include <cstdio>
#include <exception>

#include "support/chosen_files.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  try {
    burin::test::runChosenFilesOnly(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tests: %s\n", e.what());
    return 1;
  }
  return RUN_ALL_TESTS();
}
