#include "build_info.hpp"

#include <sched.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <cstdlib>

#include "burin/common/error.hpp"
#include "burin/common/memory_room.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/picture.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/offscreen_context.hpp"
#include "burin/node/thread_share.hpp"

namespace burin::host {

namespace {

std::string line(const char* label, const std::string& value) {
  return fmt::format("{:<13}{}\n", label, value);
}

std::string compiler() {
#if defined(__clang__)
  const char* const name = "Clang";
#else
  const char* const name = "GCC";
#endif
  return fmt::format("{} {}, {}", name, __VERSION__, BURIN_BUILD_TYPE);
}

std::string mpi(const Communicator& comm) {
  char library[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  checkMpi(MPI_Get_library_version(library, &length), "MPI_Get_library_version");
  int major = 0, minor = 0;
  checkMpi(MPI_Get_version(&major, &minor), "MPI_Get_version");
  const std::string text{library, static_cast<std::size_t>(length)};
  return fmt::format("{} (MPI {}.{}), {} rank{} now", text.substr(0, text.find(',')), major, minor,
                     comm.size(), comm.size() == 1 ? "" : "s");
}

/// What `describe` returns, or why it cannot.
template <typename Describe>
std::string orWhyNot(Describe&& describe) {
  try {
    return describe();
  } catch (const Error& error) {
    return error.what();
  }
}

std::string openGl(node::GlBackend backend) {
  return orWhyNot([&] {
    const node::GlDescription gl = node::OffscreenContext{{0, backend}}.description();
    return fmt::format("{}, {}, OpenGL {}, textures to {} voxels and {} pixels a side", gl.vendor,
                       gl.renderer, gl.version, gl.largest3dTexture, gl.largestTexture);
  });
}

std::string threads(int share) {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  const bool isKnown = sched_getaffinity(0, sizeof mask, &mask) == 0;
  const char* const set = std::getenv("LP_NUM_THREADS");
  return fmt::format("{} for rank 0, which may use {} of {} CPUs; LP_NUM_THREADS {}",
                     set != nullptr ? set : fmt::format("{}", share),
                     isKnown ? CPU_COUNT(&mask) : 1, sysconf(_SC_NPROCESSORS_ONLN),
                     set != nullptr ? "says so" : "is not set");
}

std::string memory() {
  return byteText(memoryRoom().host) + " left on this host or in its control group";
}

}  // namespace

std::string buildInfo(const Communicator& comm) {
  const int share = node::threadShare(comm, true);
  if (!comm.isRoot()) return {};
  return line("burin", programVersion()) + line("compiler", compiler()) + line("MPI", mpi(comm)) +
         line("OSMesa", openGl(node::GlBackend::kOsMesa)) +
         line("EGL", openGl(node::GlBackend::kEgl)) +
         line("OpenImageIO", orWhyNot(pictureLibraryVersion)) + line("zstd", ZSTD_versionString()) +
         line("zlib", zlibVersion()) + line("threads", threads(share)) + line("memory", memory()) +
         line("limits", fmt::format("pictures to {0}x{0} pixels", kLargestImageSide));
}

}  // namespace burin::host
