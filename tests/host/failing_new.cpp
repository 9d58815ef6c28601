// Preloaded into the program by failing_rank_program_test: the n-th allocation that burin's own
// code makes on one rank fails, which can be anywhere from reading the command line to writing the
// picture. Without n, the allocations of every rank are counted.
//
//   BURIN_FAIL_RANK, BURIN_FAIL_AT   which rank, and which of its allocations, from 1
//   BURIN_COUNT_FILE                 NAME: the count is written to NAMErank when the program ends

#include <link.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

struct Range {
  std::uintptr_t begin = 0, end = 0;
};

/// The code of the program itself: the first object that the loader lists.
int findProgram(dl_phdr_info* info, std::size_t /*size*/, void* range) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
    *static_cast<Range*>(range) = {begin, begin + part.p_memsz};
  }
  return 1;  // the others are libraries
}

long numberFrom(const char* variable) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::atol(text) : 0;
}

/// What this process is to do.
struct Plan {
  Range program;
  long rank = numberFrom("OMPI_COMM_WORLD_RANK");
  long failAt = 0;
  Plan() {
    if (std::strcmp(program_invocation_short_name, "burin") != 0) return;  // the launcher
    dl_iterate_phdr(findProgram, &program);
    if (rank == numberFrom("BURIN_FAIL_RANK")) failAt = numberFrom("BURIN_FAIL_AT");
  }
};

constexpr std::size_t kLarge = 1024;
long count = 0;

bool mustFail(std::size_t bytes, const void* caller) {
  if (bytes < kLarge) return false;
  static const Plan plan;
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  return at >= plan.program.begin && at < plan.program.end && ++count == plan.failAt;
}

[[gnu::destructor]] void writeCount() {
  const char* const name = std::getenv("BURIN_COUNT_FILE");
  if (name == nullptr || std::strcmp(program_invocation_short_name, "burin") != 0) return;
  char file[4096];
  std::snprintf(file, sizeof file, "%s%ld", name, numberFrom("OMPI_COMM_WORLD_RANK"));
  if (std::FILE* const out = std::fopen(file, "w")) {
    std::fprintf(out, "%ld\n", count);
    std::fclose(out);
  }
}

}  // namespace

void* operator new(std::size_t bytes) {
  if (mustFail(bytes, __builtin_return_address(0))) throw std::bad_alloc{};
  if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc{};
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
