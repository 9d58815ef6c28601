#pragma once

#include <array>
#include <span>
#include <vector>

#include "bench/compositing_input.hpp"

namespace burin::host::bench {

/// What every contender should come to: the serial combination in double precision. On rank 0;
/// empty on the others.
class ExactFrame {
 public:
  /// Collective: rank 0 is sent the subimages one after the other, front to back.
  ExactFrame(const Communicator& comm, const CompositingInput& input);

  /// Local. Largest difference of any channel; infinite if `frame` has not that many pixels.
  double largestDifference(std::span<const Rgba> frame) const;

 private:
  void putBehind(const PixelRect& active, std::span<const Rgba> pixels);

  ImageSize frame_;
  std::vector<std::array<double, 4>> pixels_;
};

}  // namespace burin::host::bench
