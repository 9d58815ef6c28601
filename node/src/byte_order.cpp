#include "byte_order.hpp"

#include <cstdint>
#include <cstring>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

template <typename Word, typename Swap>
void swapEach(std::span<std::byte> elements, Swap swap) {
  for (std::size_t at = 0; at < elements.size(); at += sizeof(Word)) {
    Word word;
    std::memcpy(&word, elements.data() + at, sizeof word);
    word = swap(word);
    std::memcpy(elements.data() + at, &word, sizeof word);
  }
}

}  // namespace

void swapBytes(std::span<std::byte> elements, std::size_t bytesPerElement) {
  BURIN_CHECK_EQ(elements.size() % bytesPerElement, std::size_t{0});
  if (bytesPerElement == 1) return;
  if (bytesPerElement == 2) {
    swapEach<std::uint16_t>(elements, [](std::uint16_t word) { return __builtin_bswap16(word); });
    return;
  }
  if (bytesPerElement == 4) {
    swapEach<std::uint32_t>(elements, [](std::uint32_t word) { return __builtin_bswap32(word); });
    return;
  }
  BURIN_CHECK_EQ(bytesPerElement, std::size_t{8});
  swapEach<std::uint64_t>(elements, [](std::uint64_t word) { return __builtin_bswap64(word); });
}

}  // namespace burin::node
