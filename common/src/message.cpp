#include "burin/common/message.hpp"

#include <algorithm>
#include <limits>

#include "burin/common/error.hpp"

namespace burin {

namespace {

void appendLittleEndian(std::vector<std::byte>& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

std::uint32_t littleEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
  }
  return value;
}

/// Moves bytes from the front of `input` to the end of `out` until that has `size` of them.
void fill(std::vector<std::byte>& out, std::size_t size, std::span<const std::byte>& input) {
  const auto taken = input.first(std::min(input.size(), size - out.size()));
  out.insert(out.end(), taken.begin(), taken.end());
  input = input.subspan(taken.size());
}

}  // namespace

std::vector<std::byte> encodeMessage(std::uint16_t type, std::span<const std::byte> payload) {
  constexpr auto kLongest = std::numeric_limits<std::uint32_t>::max();
  if (payload.size() > kLongest) {
    fail(ExitCode::kUsage, "message of type {}: at most {} bytes expected, {} given", type,
         kLongest, payload.size());
  }
  std::vector<std::byte> out;
  out.reserve(kMessageHeaderBytes + payload.size());
  appendLittleEndian(out, static_cast<std::uint32_t>(payload.size()), 4);
  appendLittleEndian(out, kProtocolVersion, 2);
  appendLittleEndian(out, type, 2);
  out.insert(out.end(), payload.begin(), payload.end());
  return out;
}

MessageReader::Status MessageReader::readHeader() {
  const std::span<const std::byte> header{header_};
  const std::uint32_t length = littleEndian(header.first(4));
  if (littleEndian(header.subspan(4, 2)) != kProtocolVersion) return Status::kWrongVersion;
  if (length > longestPayload_) return Status::kTooLong;
  payloadBytes_ = length;
  message_.type = static_cast<std::uint16_t>(littleEndian(header.subspan(6, 2)));
  return Status::kNeedsMore;
}

MessageReader::Status MessageReader::read(std::span<const std::byte>& input) {
  if (status_ == Status::kTooLong || status_ == Status::kWrongVersion) return status_;
  if (status_ == Status::kMessage) {
    header_.clear();
    message_ = {};
    status_ = Status::kNeedsMore;
  }
  if (header_.size() < kMessageHeaderBytes) {
    fill(header_, kMessageHeaderBytes, input);
    if (header_.size() < kMessageHeaderBytes) return status_;
    status_ = readHeader();
    if (status_ != Status::kNeedsMore) return status_;
  }
  // Grows with the bytes that arrive: a length alone makes nobody allocate.
  fill(message_.payload, payloadBytes_, input);
  if (message_.payload.size() == payloadBytes_) status_ = Status::kMessage;
  return status_;
}

}  // namespace burin
