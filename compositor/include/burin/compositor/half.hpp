#pragma once

#include <bit>
#include <cstdint>

namespace burin::compositor {

/// IEEE 754 binary16 in an integer. Written out here because a frame converts millions of them:
/// GLM's conversion takes three times as long and Imath's needs its own library.
enum class Half : std::uint16_t {};

inline constexpr float kLargestHalf = 65504.0f;

/// The nearest half, ties to even. Finite values beyond ±65504 become ±65504, not infinite;
/// infinities and NaN stay what they are. Off by at most 2^-11 of the value, or 2^-25 below 2^-14.
constexpr Half toHalf(float value) {
  constexpr std::uint32_t kInfinity = 0x7f800000;
  constexpr auto kLargest = std::bit_cast<std::uint32_t>(kLargestHalf);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const std::uint32_t given = bits & 0x7fffffffu;
  const std::uint32_t finite = given < kLargest ? given : kLargest;
  // Subnormal halves are multiples of 2^-24, which is the spacing of floats from 0.5 to 1: adding
  // 0.5 rounds to one of them and leaves it in the low bits.
  const std::uint32_t subnormal =
      std::bit_cast<std::uint32_t>(std::bit_cast<float>(finite) + 0.5f) - 0x3f000000u;
  // The others lose 13 bits; a carry goes into the exponent, whose bias falls from 127 to 15.
  const std::uint32_t isOdd = (finite >> 13) & 1u;
  const std::uint32_t normal = (finite - (112u << 23) + 0xfffu + isOdd) >> 13;
  const std::uint32_t rounded = finite < (113u << 23) ? subnormal : normal;
  const std::uint32_t special = given == kInfinity ? 0x7c00u : 0x7e00u;
  return static_cast<Half>(sign | (given < kInfinity ? rounded : special));
}

/// Exact.
constexpr float toFloat(Half half) {
  const std::uint32_t bits = static_cast<std::uint16_t>(half);
  const std::uint32_t sign = (bits & 0x8000u) << 16;
  const std::uint32_t magnitude = bits & 0x7fffu;
  const auto subnormal = std::bit_cast<std::uint32_t>(static_cast<float>(magnitude) * 0x1p-24f);
  const std::uint32_t bias = magnitude < 0x7c00u ? 112u << 23 : 224u << 23;
  const std::uint32_t normal = (magnitude << 13) + bias;
  return std::bit_cast<float>(sign | (magnitude < 0x400u ? subnormal : normal));
}

}  // namespace burin::compositor
