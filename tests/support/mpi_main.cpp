// GoogleTest's main for programs that run under MPI: every rank runs every case. Rank 0 prints as
// usual, the others only their failures; all end with failure if any rank failed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include "support/chosen_files.hpp"
#include "support/mpi_test.hpp"

namespace burin::test {

namespace {

const Communicator* worldOfTests = nullptr;

/// What ranks other than 0 say: where a case failed, and on which rank.
class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(Rank rank) : rank_{static_cast<int>(rank)} {}

  void OnTestStart(const testing::TestInfo& test) override {
    name_ = fmt::format("{}.{}", test.test_suite_name(), test.name());
  }

  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    const char* file = result.file_name();  // null for an exception
    const auto line =
        fmt::format("[rank {}] {} failed at {}:{}\n{}\n", rank_, name_,
                    file == nullptr ? "?" : file, result.line_number(), result.message());
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
  }

 private:
  int rank_;
  std::string name_ = "set-up";
};

int runTests(int* argc, char** argv) {
  const Communicator comm{MPI_COMM_WORLD};
  worldOfTests = &comm;
  testing::InitGoogleTest(argc, argv);
  runChosenFilesOnly(*argc, argv);
  if (!comm.isRoot()) {
    GTEST_FLAG_SET(output, "");  // one report file, rank 0's
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    const std::unique_ptr<testing::TestEventListener> printer{
        listeners.Release(listeners.default_result_printer())};
    listeners.Append(new FailurePrinter{comm.rank()});  // the list owns it
  }
  std::int64_t failed = RUN_ALL_TESTS() == 0 ? 0 : 1;
  allReduce(comm, std::span{&failed, 1}, MPI_MAX);
  worldOfTests = nullptr;
  return static_cast<int>(failed);
}

}  // namespace

const Communicator& world() {
  BURIN_CHECK(worldOfTests != nullptr);
  return *worldOfTests;
}

}  // namespace burin::test

#ifdef __SANITIZE_ADDRESS__
// Finalizing unloads MPI's plug-ins, and a leak in an unloaded library has no name to suppress it
// by.
extern "C" int dlclose(void* /*library*/) {
  return 0;
}
#endif

namespace {

/// What Open MPI takes when it starts and never gives back is not looked at: where the C library
/// has no debugging symbols, no suppression by name (lsan.supp) finds what its asprintf() made.
burin::MpiRuntime startMpi(int* argc, char*** argv) {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler disabler;
#endif
  return burin::MpiRuntime{argc, argv};
}

}  // namespace

int main(int argc, char** argv) {
  const burin::MpiRuntime runtime = startMpi(&argc, &argv);
  try {
    return burin::test::runTests(&argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tests: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);  // the other ranks wait for this one
  }
  return 1;
}
