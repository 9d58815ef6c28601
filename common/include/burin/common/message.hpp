#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace burin {

/// Messages of a byte stream (a socket). Each begins with eight bytes, little-endian:
///   u32 payload length in bytes (may be 0) · u16 protocol version · u16 message type
/// followed by the payload. Types are only ever appended.
inline constexpr std::uint16_t kProtocolVersion = 1;
inline constexpr std::size_t kMessageHeaderBytes = 8;

struct Message {
  std::uint16_t type = 0;
  std::vector<std::byte> payload;
  friend bool operator==(const Message&, const Message&) = default;
};

/// Header and payload. Throws Error{kUsage} if the payload does not fit the length field.
std::vector<std::byte> encodeMessage(std::uint16_t type, std::span<const std::byte> payload);

/// Takes a byte stream apart, however it was split on its way. Local; never throws on bad bytes.
class MessageReader {
 public:
  enum class Status {
    kNeedsMore,     ///< all input was used, the message is not complete yet
    kMessage,       ///< `message()` is complete; there may be input left
    kTooLong,       ///< the length is over the bound: nothing was allocated, drop the connection
    kWrongVersion,  ///< the peer speaks another protocol: drop the connection
  };

  /// Longer payloads are refused.
  explicit MessageReader(std::uint32_t longestPayload) : longestPayload_{longestPayload} {}

  /// Takes from the front of `input` what belongs to the current message, and no more. After
  /// kMessage the next call begins the next message; kTooLong and kWrongVersion are final.
  Status read(std::span<const std::byte>& input);
  /// The message that `read` has completed.
  Message& message() { return message_; }

 private:
  Status readHeader();

  std::uint32_t longestPayload_;
  Status status_ = Status::kMessage;  ///< "the last message is complete": begin with a new one
  std::vector<std::byte> header_;
  std::size_t payloadBytes_ = 0;  ///< of the current message; valid once the header is complete
  Message message_;
};

}  // namespace burin
