#include "burin/compositor/message_layout.hpp"

#include <algorithm>
#include <cstring>

#include "burin/common/error.hpp"
#include "burin/common/zstd_codec.hpp"
#include "burin/compositor/colour_prediction.hpp"

namespace burin::compositor {

namespace {

constexpr std::uint32_t kMark = 0x334e5542;  // "BUN3"
constexpr std::uint32_t kHasReferences = 1;
constexpr std::uint32_t kIsPacked = 2;
constexpr std::size_t kWord = 4;

struct Header {
  std::uint32_t mark;
  std::uint32_t flags;
  std::uint32_t pixelBytes;
  std::uint32_t entries;
  std::uint64_t regionBegin;
  std::uint64_t regionEnd;
  std::uint64_t runs;
  std::uint64_t payloadBytes;  ///< before zstd
};
static_assert(sizeof(Header) == MessageLayout::kHeaderBytes);

struct ReferenceEntry {
  std::uint32_t position, runs;
  std::int32_t rank;
  std::uint32_t stride;
  std::uint64_t offset;
};
static_assert(sizeof(ReferenceEntry) == 24);

/// Byte k of every word next to each other: exponents compress, mantissas do not. The bytes beyond
/// the last whole word stay at the end.
void splitPlanes(std::span<const std::byte> in, std::span<std::byte> out) {
  const std::size_t words = in.size() / kWord;
  for (std::size_t k = 0; k < kWord; ++k) {
    for (std::size_t i = 0; i < words; ++i) out[k * words + i] = in[i * kWord + k];
  }
  std::ranges::copy(in.subspan(words * kWord),
                    out.begin() + static_cast<std::ptrdiff_t>(words * kWord));
}

void joinPlanes(std::span<const std::byte> in, std::span<std::byte> out) {
  const std::size_t words = in.size() / kWord;
  for (std::size_t k = 0; k < kWord; ++k) {
    for (std::size_t i = 0; i < words; ++i) out[i * kWord + k] = in[k * words + i];
  }
  std::ranges::copy(in.subspan(words * kWord),
                    out.begin() + static_cast<std::ptrdiff_t>(words * kWord));
}

TileEntry readEntry(const std::byte* bytes, bool hasReferences) {
  ReferenceEntry entry{0, 0, -1, 0, 0};
  std::memcpy(&entry, bytes, hasReferences ? sizeof entry : 8);
  return {entry.position, entry.runs, entry.stride, {entry.rank, entry.offset}};
}

/// Checks one tile's runs; returns their pixels. In place, a run lies in one row, and behind the
/// one before it in memory, too.
std::size_t activeOf(std::span<const Run> runs, const TileEntry& entry, const PixelRect& rect) {
  const auto width = static_cast<std::uint32_t>(rect.width());
  const bool isInPlace = entry.place.rank >= 0 && entry.stride != 0;
  std::size_t active = 0;
  std::size_t end = 0;         // of the run before
  std::int64_t memoryEnd = 0;  // likewise, pixels from the first row's begin
  for (const Run& run : runs) {
    const std::int64_t memory = std::int64_t{run.first / width} * entry.stride + run.first % width;
    const bool isMisplaced =
        isInPlace && (run.first / width != run.last / width || (active > 0 && memory < memoryEnd));
    if (run.last < run.first || run.first < end || run.end() > rect.pixels() || isMisplaced) {
      fail(ExitCode::kRank, "run {}…{} of a tile of {} pixels, after {}", run.first, run.last,
           rect.pixels(), end);
    }
    active += run.pixels();
    end = run.end();
    memoryEnd = memory + run.pixels();
  }
  return active;
}

/// The runs; copied into `memory` only if they lie where no Run may.
std::span<const Run> runsAt(std::span<const std::byte> bytes, FrameMemory& memory) {
  const std::size_t count = bytes.size() / sizeof(Run);
  if (isAligned(bytes.data(), alignof(Run))) {
    return {reinterpret_cast<const Run*>(bytes.data()), count};
  }
  const auto copy = memory.allocate<Run>(count);
  if (count > 0) std::memcpy(copy.data(), bytes.data(), bytes.size());
  return copy;
}

std::span<const std::byte> unpacked(std::span<const std::byte> payload, std::size_t bytes,
                                    bool isColour, FrameMemory& memory) {
  const auto planes = decompressZstd(payload, bytes);
  if (!planes || planes->size() != bytes) {
    fail(ExitCode::kRank, "the packed pixels are damaged");
  }
  const auto out = memory.allocate<std::byte>(bytes);
  joinPlanes(*planes, out);
  if (!isColour) return out;
  const auto pixels = memory.allocate<std::byte>(bytes);
  restoreColours(out, pixels);
  return pixels;
}

}  // namespace

std::span<const std::byte> finishMessage(std::span<std::byte> room, const MessageLayout& layout,
                                         std::span<const TileEntry> entries,
                                         const MessageContent& content, bool isPacked,
                                         FrameMemory& memory) {
  std::byte* out = room.data() + MessageLayout::kHeaderBytes;
  for (const TileEntry& entry : entries) {
    const ReferenceEntry full{entry.position, entry.runs, entry.place.rank, entry.stride,
                              entry.place.offset};
    std::memcpy(out, &full, layout.entryBytes());
    out += layout.entryBytes();
  }
  const std::size_t runsEnd = layout.runsBegin() + layout.runs * sizeof(Run);
  std::ranges::fill(room.subspan(runsEnd, layout.payloadBegin() - runsEnd), std::byte{0});
  const auto payload = room.subspan(layout.payloadBegin(), content.payloadBytes);
  std::size_t carried = payload.size();
  if (isPacked) {
    std::span<const std::byte> pixels = payload;
    if (content.isColour) {
      const auto differences = memory.allocate<std::byte>(payload.size());
      predictColours(payload, differences);
      pixels = differences;
    }
    const auto planes = memory.allocate<std::byte>(payload.size());
    splitPlanes(pixels, planes);
    const auto packed = compressZstd(planes);
    isPacked = packed.size() < payload.size();
    if (isPacked) {
      carried = packed.size();
      std::ranges::copy(packed, payload.begin());
    }
  }
  const Header header{kMark,
                      (layout.hasReferences ? kHasReferences : 0) | (isPacked ? kIsPacked : 0),
                      static_cast<std::uint32_t>(content.pixelBytes),
                      static_cast<std::uint32_t>(layout.entries),
                      content.region.begin,
                      content.region.end,
                      layout.runs,
                      content.payloadBytes};
  std::memcpy(room.data(), &header, sizeof header);
  return room.first(layout.payloadBegin() + carried);
}

std::array<std::byte, MessageLayout::kHeaderBytes> emptyTileMessage(const Region& region,
                                                                    std::size_t pixelBytes) {
  std::array<std::byte, MessageLayout::kHeaderBytes> message;
  const Header header{kMark, 0, static_cast<std::uint32_t>(pixelBytes), 0, region.begin, region.end,
                      0,     0};
  std::memcpy(message.data(), &header, sizeof header);
  return message;
}

MessageParts readMessage(std::span<const std::byte> message, const Region& region,
                         std::size_t minPixelBytes, std::size_t maxPixelBytes, bool isColour,
                         const std::function<PixelRect(std::size_t)>& rectOf, FrameMemory& memory) {
  if (message.size() < MessageLayout::kHeaderBytes) {
    fail(ExitCode::kRank, "at least {} bytes expected, {} received", MessageLayout::kHeaderBytes,
         message.size());
  }
  Header header;
  std::memcpy(&header, message.data(), sizeof header);
  if (header.mark != kMark || header.flags > (kHasReferences | kIsPacked)) {
    fail(ExitCode::kRank, "not a compositing message");
  }
  if (header.pixelBytes != maxPixelBytes) {
    fail(ExitCode::kRank, "pixels of {} bytes expected, of {} received", maxPixelBytes,
         header.pixelBytes);
  }
  if (header.regionBegin != region.begin || header.regionEnd != region.end) {
    fail(ExitCode::kRank, "region [{},{}) expected, [{},{}) received", region.begin, region.end,
         header.regionBegin, header.regionEnd);
  }
  const MessageLayout layout{header.entries, static_cast<std::size_t>(header.runs),
                             (header.flags & kHasReferences) != 0};
  // A tile has at least one run and a run four bytes: more than fit cannot be.
  if (header.entries > region.length() || header.runs > message.size() / sizeof(Run) ||
      layout.payloadBegin() > message.size()) {
    fail(ExitCode::kRank, "{} tiles with {} runs do not fit in {} bytes", header.entries,
         header.runs, message.size());
  }

  MessageParts parts;
  parts.runs = runsAt(message.subspan(layout.runsBegin(), layout.runs * sizeof(Run)), memory);
  parts.entries.reserve(layout.entries);
  std::size_t run = 0;
  std::size_t active = 0;  // by value
  std::size_t next = region.begin;
  for (std::size_t i = 0; i < layout.entries; ++i) {
    const TileEntry entry =
        readEntry(message.data() + MessageLayout::kHeaderBytes + i * layout.entryBytes(),
                  layout.hasReferences);
    if (entry.position < next || entry.position >= region.end) {
      fail(ExitCode::kRank, "a tile at position {} expected, {} received", next, entry.position);
    }
    if (entry.runs == 0 || entry.runs > layout.runs - run) {
      fail(ExitCode::kRank, "{} runs in a tile, {} left", entry.runs, layout.runs - run);
    }
    const std::size_t pixels =
        activeOf(parts.runs.subspan(run, entry.runs), entry, rectOf(entry.position));
    if (entry.place.rank < 0) active += pixels;
    run += entry.runs;
    next = entry.position + 1;
    parts.entries.push_back(entry);
  }
  if (run != layout.runs) fail(ExitCode::kRank, "{} runs expected, {} received", run, layout.runs);

  if (header.payloadBytes < active * minPixelBytes ||
      header.payloadBytes > active * maxPixelBytes) {
    fail(ExitCode::kRank, "{} bytes for {} pixels", header.payloadBytes, active);
  }
  parts.payload = message.subspan(layout.payloadBegin());
  if ((header.flags & kIsPacked) != 0) {
    parts.payload =
        unpacked(parts.payload, static_cast<std::size_t>(header.payloadBytes), isColour, memory);
  } else if (parts.payload.size() != header.payloadBytes) {
    fail(ExitCode::kRank, "{} bytes of pixels expected, {} received", header.payloadBytes,
         parts.payload.size());
  }
  return parts;
}

bool isAligned(const std::byte* address, std::size_t alignment) {
  return reinterpret_cast<std::uintptr_t>(address) % alignment == 0;
}

std::span<const std::byte> takeBytes(std::span<const std::byte>& bytes, std::size_t count) {
  if (count > bytes.size()) {
    fail(ExitCode::kRank, "{} more bytes of pixels expected, {} received", count, bytes.size());
  }
  const auto taken = bytes.first(count);
  bytes = bytes.subspan(count);
  return taken;
}

std::size_t checkedLength(std::size_t loaded) {
  if (loaded == 0) fail(ExitCode::kRank, "a pixel is damaged");
  return loaded;
}

void failShared(const TileEntry& entry) {
  fail(ExitCode::kRank, "tile {} refers to offset {} of rank {}'s memory, which is not shared",
       entry.position, entry.place.offset, entry.place.rank);
}

void failLength(std::size_t surplus) {
  fail(ExitCode::kRank, "{} bytes behind the last pixel", surplus);
}

}  // namespace burin::compositor
