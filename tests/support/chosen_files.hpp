#pragma once

namespace burin::test {

/// For programs that several test files share: with an argument `--files=a_test.cpp:b_test.cpp`,
/// narrows GoogleTest's filter to the cases that stand in these files (folders before a name do not
/// count). Does nothing without that argument. Call it between InitGoogleTest and RUN_ALL_TESTS.
/// Throws std::runtime_error if no case stands in them, or if a case in another file has the same
/// name as one of theirs.
void runChosenFilesOnly(int argc, const char* const* argv);

}  // namespace burin::test
