#include "picture_need.hpp"

#include "burin/common/error.hpp"

namespace burin::host {

MemoryNeed pictureNeed(const Communicator& comm, ImageSize size) {
  constexpr std::size_t kBytesPerPixel = 2 * sizeof(Rgba) + 4;
  if (!comm.isRoot()) return {};
  return {static_cast<std::int64_t>(size.pixels() * kBytesPerPixel),
          fmt::format("a picture of {}x{} pixels", size.width, size.height)};
}

}  // namespace burin::host
