#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "volume_files.hpp"

namespace burin::test {

/// A NIfTI-1 header written byte by byte, at the offsets of the standard's table.
struct NiftiBytes {
  std::array<std::int16_t, 8> dim{3, 1, 1, 1, 1, 1, 1, 1};
  std::int16_t datatype = 2;
  std::int16_t bitsPerVoxel = 8;
  std::array<float, 8> pixdim{1, 1, 1, 1, 0, 0, 0, 0};
  float voxOffset = 352;
  float slope = 0;
  float intercept = 0;
  std::int16_t qformCode = 0;
  std::int16_t sformCode = 0;
  std::array<float, 6> quaternAndOffset{};  ///< b c d, x y z
  std::array<float, 12> srow{};
  std::string magic = std::string{"n+1\0", 4};

  /// 348 bytes of header and four that say "no extension".
  std::string bytes(bool bigEndian) const {
    std::string out(352, '\0');
    const auto put = [&](std::size_t at, const auto value) {
      const std::string text = encoded(value, bigEndian);
      out.replace(at, text.size(), text);
    };
    const auto putAll = [&](std::size_t at, const auto& values) {
      for (const auto value : values) {
        put(at, value);
        at += sizeof value;
      }
    };
    put(0, std::int32_t{348});
    putAll(40, dim);
    put(70, datatype);
    put(72, bitsPerVoxel);
    putAll(76, pixdim);
    put(108, voxOffset);
    put(112, slope);
    put(116, intercept);
    put(252, qformCode);
    put(254, sformCode);
    putAll(256, quaternAndOffset);
    putAll(280, srow);
    out.replace(344, 4, magic);
    return out;
  }
};

}  // namespace burin::test
