#pragma once

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "burin/node/brick_source.hpp"
#include "support/temporary_folder.hpp"

namespace burin::test {

/// The value's bytes in the asked order.
template <typename T>
std::string encoded(T value, bool bigEndian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (bigEndian != (std::endian::native == std::endian::big)) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

template <typename T>
std::string encoded(const std::vector<T>& values, bool bigEndian) {
  std::string bytes;
  for (const T value : values) bytes += encoded(value, bigEndian);
  return bytes;
}

inline std::string gzipped(std::string_view bytes) {
  z_stream z{};
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error{"deflateInit2 failed"};
  }
  std::string out(deflateBound(&z, bytes.size()) + 64, '\0');
  std::vector<Bytef> in(bytes.begin(), bytes.end());
  z.next_in = in.data();
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  if (deflate(&z, Z_FINISH) != Z_STREAM_END) throw std::runtime_error{"deflate failed"};
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

/// Voxels with the type's extremes first, then pseudo-random ones.
template <typename T>
std::vector<T> sampleVoxels(std::size_t count) {
  std::mt19937 random{7};
  std::vector<T> voxels{std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max(), T{0},
                        T{1}};
  while (voxels.size() < count) {
    const auto bits = static_cast<std::uint32_t>(random());
    if constexpr (std::is_same_v<T, float>) {
      voxels.push_back((static_cast<float>(bits) - 2e9f) * 1e-6f);
    } else {
      voxels.push_back(static_cast<T>(bits));
    }
  }
  voxels.resize(count);
  return voxels;
}

/// What `region` of a volume of `dims` voxels holds, picked voxel by voxel.
template <typename T>
std::vector<T> picked(const std::vector<T>& voxels, const glm::ivec3& dims,
                      const IndexBox& region) {
  std::vector<T> part;
  for (int k = region.lo.z; k < region.hi.z; ++k) {
    for (int j = region.lo.y; j < region.hi.y; ++j) {
      for (int i = region.lo.x; i < region.hi.x; ++i) {
        part.push_back(voxels[static_cast<std::size_t>(i + dims.x * (j + dims.y * k))]);
      }
    }
  }
  return part;
}

/// A region of a source as numbers of its type.
template <typename T>
std::vector<T> loaded(node::BrickSource& source, const IndexBox& region) {
  std::vector<T> voxels(region.count());
  source.load(region, std::as_writable_bytes(std::span{voxels}));
  return voxels;
}

template <typename T>
std::vector<T> loadedWhole(node::BrickSource& source) {
  return loaded<T>(source, {glm::ivec3{0}, source.info().grid.dims});
}

inline VolumeChoice fileChoice(const std::string& file) {
  VolumeChoice choice;
  choice.file = file;
  return choice;
}

template <typename T>
constexpr node::VoxelType kVoxelTypeOf = std::is_same_v<T, std::uint8_t>    ? node::VoxelType::kU8
                                         : std::is_same_v<T, std::int16_t>  ? node::VoxelType::kI16
                                         : std::is_same_v<T, std::uint16_t> ? node::VoxelType::kU16
                                                                            : node::VoxelType::kF32;

}  // namespace burin::test
