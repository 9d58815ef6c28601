#include "burin/common/message.hpp"

#include <gtest/gtest.h>

#include <random>

namespace burin {
namespace {

using Status = MessageReader::Status;

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  return bytes;
}

TEST(Message, HasLittleEndianLengthVersionAndType) {
  const auto payload = bytesOf({7, 8, 9});
  EXPECT_EQ(encodeMessage(0x1234, payload), bytesOf({3, 0, 0, 0, 1, 0, 0x34, 0x12, 7, 8, 9}));
}

TEST(MessageReader, ReadsAMessageThatArrivesWhole) {
  const auto stream = encodeMessage(5, bytesOf({1, 2}));
  MessageReader reader{100};
  std::span<const std::byte> input{stream};
  ASSERT_EQ(reader.read(input), Status::kMessage);
  EXPECT_EQ(reader.message(), (Message{5, bytesOf({1, 2})}));
  EXPECT_TRUE(input.empty());
  EXPECT_EQ(reader.read(input), Status::kNeedsMore);
}

std::vector<Message> someMessages() {
  return {{1, {}}, {2, bytesOf({1})}, {3, std::vector<std::byte>(1000, std::byte{9})}, {4, {}}};
}

std::vector<std::byte> streamOf(const std::vector<Message>& messages) {
  std::vector<std::byte> stream;
  for (const auto& message : messages) {
    const auto encoded = encodeMessage(message.type, message.payload);
    stream.insert(stream.end(), encoded.begin(), encoded.end());
  }
  return stream;
}

/// Feeds `piece`; returns the messages it completes.
std::vector<Message> feed(MessageReader& reader, std::span<const std::byte> piece) {
  std::vector<Message> complete;
  while (reader.read(piece) == Status::kMessage) complete.push_back(reader.message());
  EXPECT_TRUE(piece.empty());
  return complete;
}

TEST(MessageReader, AcceptsByteByByte) {
  MessageReader reader{1000};
  std::vector<Message> received;
  for (const std::byte b : streamOf(someMessages())) {
    for (auto& message : feed(reader, std::span{&b, 1})) received.push_back(std::move(message));
  }
  EXPECT_EQ(received, someMessages());
}

TEST(MessageReader, AcceptsAnySplit) {
  std::mt19937 random{11};
  const auto stream = streamOf(someMessages());
  for (int trial = 0; trial < 100; ++trial) {
    MessageReader reader{1000};
    std::vector<Message> received;
    std::span<const std::byte> rest{stream};
    while (!rest.empty()) {
      const auto size = std::uniform_int_distribution<std::size_t>{0, rest.size()}(random);
      for (auto& message : feed(reader, rest.first(size))) received.push_back(std::move(message));
      rest = rest.subspan(size);
    }
    ASSERT_EQ(received, someMessages());
  }
}

TEST(MessageReader, TruncatedMessageIsNeverComplete) {
  const auto stream = encodeMessage(1, bytesOf({1, 2, 3}));
  for (std::size_t size = 0; size < stream.size(); ++size) {
    MessageReader reader{100};
    auto input = std::span<const std::byte>{stream}.first(size);
    EXPECT_EQ(reader.read(input), Status::kNeedsMore) << size;
  }
}

TEST(MessageReader, RefusesTheFirstLengthOverTheBoundForGood) {
  MessageReader atBound{3};
  const auto stream = encodeMessage(1, bytesOf({1, 2, 3}));
  std::span<const std::byte> input{stream};
  EXPECT_EQ(atBound.read(input), Status::kMessage);

  MessageReader below{2};
  input = stream;
  EXPECT_EQ(below.read(input), Status::kTooLong);
  const auto fine = encodeMessage(1, {});
  input = fine;
  EXPECT_EQ(below.read(input), Status::kTooLong);
}

TEST(MessageReader, HugeLengthAllocatesNothing) {
  const auto header = bytesOf({0xff, 0xff, 0xff, 0xff, 1, 0, 1, 0});
  MessageReader bounded{1 << 20};
  std::span<const std::byte> input{header};
  EXPECT_EQ(bounded.read(input), Status::kTooLong);

  MessageReader unbounded{0xffffffffU};  // even then memory follows the bytes that arrive
  input = header;
  EXPECT_EQ(unbounded.read(input), Status::kNeedsMore);
  EXPECT_LE(unbounded.message().payload.capacity(), 1U);
}

TEST(MessageReader, RefusesAnotherVersion) {
  auto stream = encodeMessage(1, bytesOf({1}));
  stream[4] = std::byte{2};
  MessageReader reader{100};
  std::span<const std::byte> input{stream};
  EXPECT_EQ(reader.read(input), Status::kWrongVersion);
  EXPECT_EQ(reader.read(input), Status::kWrongVersion);
}

}  // namespace
}  // namespace burin
