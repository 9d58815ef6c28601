#include "burin/common/zstd_codec.hpp"

#include <zstd.h>

#include <memory>

#include "burin/common/error.hpp"

namespace burin {

namespace {

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
};
using CompressionContext = std::unique_ptr<ZSTD_CCtx, FreeContext>;

std::size_t checkZstd(std::size_t result, const char* call) {
  if (ZSTD_isError(result) != 0) {
    fail(ExitCode::kRank, "{}: {}", call, ZSTD_getErrorName(result));
  }
  return result;
}

}  // namespace

std::vector<std::byte> compressZstd(std::span<const std::byte> raw, int level) {
  const CompressionContext context{ZSTD_createCCtx()};
  if (context == nullptr) fail(ExitCode::kRank, "ZSTD_createCCtx: out of memory");
  checkZstd(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level),
            "ZSTD_c_compressionLevel");
  // Lossless coding of pixels must not turn a damaged message into a wrong picture.
  checkZstd(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1), "ZSTD_c_checksumFlag");
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  packed.resize(
      checkZstd(ZSTD_compress2(context.get(), packed.data(), packed.size(), raw.data(), raw.size()),
                "ZSTD_compress2"));
  return packed;
}

std::optional<std::vector<std::byte>> decompressZstd(std::span<const std::byte> packed,
                                                     std::size_t largestSize) {
  // The two error codes of ZSTD_getFrameContentSize are the largest unsigned values.
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > largestSize ||
      ZSTD_findFrameCompressedSize(packed.data(), packed.size()) != packed.size()) {
    return std::nullopt;
  }
  std::vector<std::byte> raw(static_cast<std::size_t>(size));
  const std::size_t written = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(written) != 0 || written != raw.size()) return std::nullopt;
  return raw;
}

}  // namespace burin
