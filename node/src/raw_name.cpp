#include "raw_name.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "stored_type.hpp"

namespace burin::node {
namespace {

/// The whole of `text` as a positive number.
std::optional<int> positiveNumber(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < 1) return std::nullopt;
  return value;
}

std::optional<glm::ivec3> parseDims(std::string_view text) {
  glm::ivec3 dims{0};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? text.find('x') : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = positiveNumber(text.substr(0, end));
    if (!number) return std::nullopt;
    dims[axis] = *number;
    text.remove_prefix(axis < 2 ? end + 1 : end);
  }
  return dims;
}

}  // namespace

std::optional<RawName> parseRawName(std::string_view fileName) {
  const std::size_t typeAt = fileName.rfind('_');
  if (typeAt == std::string_view::npos || typeAt == 0) return std::nullopt;
  const std::size_t dimsAt = fileName.rfind('_', typeAt - 1);
  if (dimsAt == std::string_view::npos) return std::nullopt;
  const std::size_t dot = fileName.find('.', typeAt);
  if (dot == std::string_view::npos || dot == typeAt + 1) return std::nullopt;
  const auto dims = parseDims(fileName.substr(dimsAt + 1, typeAt - dimsAt - 1));
  if (!dims) return std::nullopt;
  return RawName{*dims, std::string{fileName.substr(typeAt + 1, dot - typeAt - 1)}};
}

std::optional<std::string_view> canonicalTypeName(std::string_view written) {
  using Names = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Names, 11> kNames{{{"uint8", "u8"},
                                                 {"int8", "i8"},
                                                 {"uint16", "u16"},
                                                 {"int16", "i16"},
                                                 {"uint32", "u32"},
                                                 {"int32", "i32"},
                                                 {"uint64", "u64"},
                                                 {"int64", "i64"},
                                                 {"float32", "f32"},
                                                 {"float", "f32"},
                                                 {"float64", "f64"}}};
  if (storedTypeFromName(written)) return written;
  for (const auto& [name, ours] : kNames) {
    if (name == written) return ours;
  }
  return std::nullopt;
}

}  // namespace burin::node
