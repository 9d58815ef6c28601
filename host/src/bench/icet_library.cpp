#include "bench/icet_library.hpp"

#include <dlfcn.h>
#include <glob.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace fs = std::filesystem;

namespace {

/// Folders that may hold IceT, the preferred one first; with wild cards.
std::vector<std::string> candidateFolders() {
  std::vector<std::string> folders;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  if (const char* named = std::getenv("BURIN_ICET_FOLDER"); named != nullptr && *named != '\0')
    folders.emplace_back(named);
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  // build/PRESET/bin/burin and build/PRESET/tests/x_test
  if (!none) folders.push_back((program.parent_path() / "../../icet").lexically_normal().string());
  for (const char* system : {"/usr/lib/*-linux-gnu", "/usr/lib/*-linux-gnu/paraview",
                             "/usr/lib/paraview", "/usr/lib64", "/usr/lib", "/usr/local/lib"})
    folders.emplace_back(system);
  return folders;
}

/// The first file that matches a pattern with wild cards, "" if there is none.
std::string firstMatch(const std::string& pattern) {
  glob_t found{};
  std::string first;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) first = found.gl_pathv[0];
  globfree(&found);
  return first;
}

/// IceT's part for MPI: libvtkIceTMPI-pv5.11.so.1 in ParaView, libIceTMPI.so in IceT itself.
std::string findMpiPart() {
  const std::vector<std::string> folders = candidateFolders();
  for (const std::string& folder : folders) {
    for (const char* name : {"/libvtkIceTMPI*.so*", "/libIceTMPI.so*"}) {
      std::string file = firstMatch(folder + name);
      if (!file.empty()) return file;
    }
  }
  fail(ExitCode::kUsage, "no libvtkIceTMPI*.so in {} (scripts/get-icet fetches it)",
       fmt::join(folders, ", "));
}

std::shared_ptr<void> openLibrary(const std::string& file) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
  if (handle == nullptr) fail(ExitCode::kUsage, "{} cannot be loaded: {}", file, dlerror());
  return {handle, [](void* library) { dlclose(library); }};
}

/// An IceT built for another MPI would take our communicator for one of its own.
void checkMpi(const IceTLibrary& library) {
  if (dlsym(library.mpi.get(), "MPI_Comm_dup") != dlsym(RTLD_DEFAULT, "MPI_Comm_dup"))
    fail(ExitCode::kUsage, "{} is built for another MPI than burin", library.file);
}

template <typename Function>
void load(const IceTLibrary& library, const std::shared_ptr<void>& part, const char* name,
          Function*& function) {
  void* const address = dlsym(part.get(), name);
  if (address == nullptr) fail(ExitCode::kUsage, "{} has no function {}", library.file, name);
  function = reinterpret_cast<Function*>(address);
}

void loadFunctions(IceTLibrary& l) {
  load(l, l.mpi, "icetCreateMPICommunicator", l.createMpiCommunicator);
  load(l, l.mpi, "icetDestroyMPICommunicator", l.destroyMpiCommunicator);
  load(l, l.core, "icetCreateContext", l.createContext);
  load(l, l.core, "icetDestroyContext", l.destroyContext);
  load(l, l.core, "icetSetContext", l.setContext);
  load(l, l.core, "icetDiagnostics", l.diagnostics);
  load(l, l.core, "icetGetError", l.getError);
  load(l, l.core, "icetResetTiles", l.resetTiles);
  load(l, l.core, "icetAddTile", l.addTile);
  load(l, l.core, "icetSetColorFormat", l.setColorFormat);
  load(l, l.core, "icetSetDepthFormat", l.setDepthFormat);
  load(l, l.core, "icetCompositeMode", l.compositeMode);
  load(l, l.core, "icetCompositeOrder", l.compositeOrder);
  load(l, l.core, "icetStrategy", l.strategy);
  load(l, l.core, "icetSingleImageStrategy", l.singleImageStrategy);
  load(l, l.core, "icetEnable", l.enable);
  load(l, l.core, "icetDisable", l.disable);
  load(l, l.core, "icetIsEnabled", l.isEnabled);
  load(l, l.core, "icetGetIntegerv", l.getIntegers);
  load(l, l.core, "icetCompositeImage", l.compositeImage);
  load(l, l.core, "icetImageGetNumPixels", l.imagePixels);
  load(l, l.core, "icetImageGetColorcf", l.imageColour);
}

/// "…/libvtkIceTMPI-pv5.11.so.1" → "…/libvtkIceTCore-pv5.11.so.1"
std::string corePart(std::string mpiPart) {
  return mpiPart.replace(mpiPart.rfind("IceTMPI"), 7, "IceTCore");
}

}  // namespace

IceTLibrary loadIceT() {
  IceTLibrary library{};
  library.file = findMpiPart();
  // First, so that the MPI part finds it by name wherever the two lie.
  library.core = openLibrary(corePart(library.file));
  library.mpi = openLibrary(library.file);
  checkMpi(library);
  loadFunctions(library);
  return library;
}

}  // namespace burin::host::bench
