#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "volume_files.hpp"

namespace burin::test {

/// A CT slice of 4 x 2 pixels of one byte, written byte by byte: a DICOM file in explicit little
/// endian, with the elements that place it in a series.
struct DicomBytes {
  std::string series = "1.2.3.4";
  int number = 1;
  double z = 0;  ///< mm; rows and columns begin at x = y = 0
  std::string pixels = "abcdefgh";
  std::uint16_t components = 1;
  std::string jpeg;  ///< if there is any: packed, the one fragment of the one frame

  std::string bytes() const {
    const std::string instance = fmt::format("{}.{}", series, number);
    const std::string meta =
        text(0x0002, 0x0002, "UI", kCtImage) + text(0x0002, 0x0003, "UI", instance) +
        text(0x0002, 0x0010, "UI", jpeg.empty() ? "1.2.840.10008.1.2.1" : kJpeg);
    const auto metaBytes = static_cast<std::uint32_t>(meta.size());
    return std::string(128, '\0') + "DICM" +
           element(0x0002, 0x0000, "UL", encoded(metaBytes, false)) + meta +
           text(0x0008, 0x0016, "UI", kCtImage) + text(0x0008, 0x0018, "UI", instance) +
           text(0x0008, 0x0060, "CS", "CT") + text(0x0020, 0x000e, "UI", series) +
           text(0x0020, 0x0013, "IS", fmt::format("{}", number)) +
           text(0x0020, 0x0032, "DS", fmt::format("0\\0\\{}", z)) +
           text(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0") + number16(0x0028, 0x0002, components) +
           text(0x0028, 0x0004, "CS", "MONOCHROME2") + number16(0x0028, 0x0010, 2) +
           number16(0x0028, 0x0011, 4) + text(0x0028, 0x0030, "DS", "1\\1") +
           number16(0x0028, 0x0100, 8) + number16(0x0028, 0x0101, 8) + number16(0x0028, 0x0102, 7) +
           number16(0x0028, 0x0103, 0) +
           (jpeg.empty() ? element(0x7fe0, 0x0010, "OB", pixels) : packed());
  }

 private:
  static constexpr const char* kCtImage = "1.2.840.10008.5.1.4.1.1.2";

  static constexpr const char* kJpeg = "1.2.840.10008.1.2.4.50";

  /// An empty table of offsets, the fragment, the end.
  std::string packed() const {
    const auto item = [](std::uint16_t tag, std::string_view value) {
      return encoded(std::uint16_t{0xfffe}, false) + encoded(tag, false) +
             encoded(static_cast<std::uint32_t>(value.size()), false) + std::string{value};
    };
    return encoded(std::uint16_t{0x7fe0}, false) + encoded(std::uint16_t{0x0010}, false) + "OB" +
           std::string(2, '\0') + encoded(std::uint32_t{0xffffffff}, false) + item(0xe000, "") +
           item(0xe000, jpeg) + item(0xe0dd, "");
  }

  /// `value`: an even number of bytes.
  static std::string element(std::uint16_t group, std::uint16_t tag, std::string_view type,
                             std::string_view value) {
    const bool isLong = type == "OB";
    const std::string length =
        isLong ? std::string(2, '\0') + encoded(static_cast<std::uint32_t>(value.size()), false)
               : encoded(static_cast<std::uint16_t>(value.size()), false);
    return encoded(group, false) + encoded(tag, false) + std::string{type} + length +
           std::string{value};
  }
  static std::string text(std::uint16_t group, std::uint16_t tag, std::string_view type,
                          std::string value) {
    if (value.size() % 2 != 0) value += type == "UI" ? '\0' : ' ';
    return element(group, tag, type, value);
  }
  static std::string number16(std::uint16_t group, std::uint16_t tag, std::uint16_t value) {
    return element(group, tag, "US", encoded(value, false));
  }
};

}  // namespace burin::test
