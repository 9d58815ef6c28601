#include "base64_stream.hpp"

#include <algorithm>
#include <utility>

#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kTextBytes = std::size_t{64} << 10;

/// The six bits that a character stands for; -1 if it is none of the alphabet.
int sextetOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

}  // namespace

Base64Stream::Base64Stream(FileHandle file, std::uint64_t fileOffset)
    : file_{std::move(file)}, fileStart_{fileOffset}, fileNext_{fileOffset} {}

void Base64Stream::restart() {
  fileNext_ = fileStart_;
  position_ = 0;
  text_.clear();
  textUsed_ = decodedUsed_ = decodedCount_ = 0;
  ended_ = false;
}

std::uint64_t Base64Stream::mostBytes() const {
  const std::uint64_t fileBytes = regularFileSize(path());
  return (fileBytes - std::min(fileBytes, fileStart_)) / 4 * 3;
}

/// -1 at the end.
int Base64Stream::nextSextet() {
  while (true) {
    if (textUsed_ == text_.size()) {
      text_.resize(kTextBytes);
      text_.resize(file_.readSome(fileNext_, text_));
      fileNext_ += text_.size();
      textUsed_ = 0;
      if (text_.empty()) return -1;
    }
    const auto c = std::to_integer<char>(text_[textUsed_++]);
    if (kWhiteSpace.find(c) == std::string_view::npos) return sextetOf(c);
  }
}

/// Four characters to three bytes, or fewer at the end. False if there is none.
bool Base64Stream::decodeQuad() {
  unsigned bits = 0;
  std::size_t count = 0;
  for (; count < 4; ++count) {
    const int sextet = nextSextet();
    if (sextet < 0) break;
    bits |= static_cast<unsigned>(sextet) << (18 - 6 * count);
  }
  ended_ = count < 4;
  decodedCount_ = count * 6 / 8;
  decodedUsed_ = 0;
  for (std::size_t i = 0; i < decodedCount_; ++i)
    decoded_[i] = static_cast<std::byte>(bits >> (16 - 8 * i) & 0xffU);
  return decodedCount_ > 0;
}

std::size_t Base64Stream::readSome(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size()) {
    if (decodedUsed_ == decodedCount_ && (ended_ || !decodeQuad())) break;
    out[done++] = decoded_[decodedUsed_++];
  }
  position_ += done;
  return done;
}

}  // namespace burin::node
