#include "text_stream.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

#include "burin/common/error.hpp"
#include "stored_voxels.hpp"
#include "text_fields.hpp"

namespace burin::node {
namespace {

constexpr std::size_t kReadBytes = std::size_t{256} << 10;

}  // namespace

TextStream::TextStream(FileHandle file, std::uint64_t fileOffset, StoredType type,
                       std::uint64_t count)
    : file_{std::move(file)},
      fileStart_{fileOffset},
      fileNext_{fileOffset},
      type_{type},
      bytes_{count * bytesPerNumber(type)} {}

void TextStream::restart() {
  fileNext_ = fileStart_;
  position_ = 0;
  text_.clear();
  used_ = 0;
}

std::uint64_t TextStream::mostBytes() const {
  const std::uint64_t fileBytes = regularFileSize(path());
  // A number takes a digit and a space, the last one no space.
  const std::uint64_t numbers = (fileBytes - std::min(fileBytes, fileStart_) + 1) / 2;
  return numbers * bytesPerNumber(type_);
}

/// Drops what is used and reads on. False at the file's end.
bool TextStream::refill() {
  text_.erase(0, used_);
  used_ = 0;
  const std::size_t left = text_.size();
  text_.resize(left + kReadBytes);
  const std::size_t got =
      file_.readSome(fileNext_, std::as_writable_bytes(std::span{text_}.subspan(left)));
  text_.resize(left + got);
  fileNext_ += got;
  return got > 0;
}

/// Empty at the end of the file. Valid until the next call.
std::string_view TextStream::nextWord() {
  constexpr std::size_t kLongest = 1024;  // no number is as long; noise may be
  used_ = std::min(text_.find_first_not_of(kWhiteSpace, used_), text_.size());
  while (used_ == text_.size() && refill()) {
    used_ = std::min(text_.find_first_not_of(kWhiteSpace), text_.size());
  }
  std::size_t end = text_.find_first_of(kWhiteSpace, used_);
  while (end == std::string::npos && text_.size() - used_ < kLongest && refill()) {
    end = text_.find_first_of(kWhiteSpace, used_);
  }
  const auto word = std::string_view{text_}.substr(used_, std::min(end, text_.size()) - used_);
  used_ += word.size();
  return word;
}

void TextStream::decode(std::string_view word, std::byte* out) const {
  withStoredType(type_, [&](auto tag) {
    typename decltype(tag)::Type value{};
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size()) {
      fail(ExitCode::kVolume, "{}: \"{}\" where a {} number was expected (number {})",
           path().string(), word.substr(0, 40), storedTypeName(type_),
           position_ / bytesPerNumber(type_));
    }
    std::memcpy(out, &value, sizeof value);
  });
}

std::size_t TextStream::readSome(std::span<std::byte> out) {
  const std::size_t each = bytesPerNumber(type_);
  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), bytes_ - position_));
  BURIN_CHECK_EQ(wanted % each, std::size_t{0});
  for (std::size_t done = 0; done < wanted; done += each, position_ += each) {
    const std::string_view word = nextWord();
    if (word.empty()) {
      fail(ExitCode::kVolume, "{}: ends early, after {} numbers ({} expected)", path().string(),
           position_ / each, bytes_ / each);
    }
    decode(word, out.data() + done);
  }
  return wanted;
}

}  // namespace burin::node
