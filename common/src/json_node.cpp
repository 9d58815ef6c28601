#include "json_node.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace burin::json {

namespace {

constexpr std::size_t kDeepestNesting = 64;

/// Whether a byte of UTF-8 begins a character.
bool startsCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

/// Line and column of byte offsets.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_{text} {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') starts_.push_back(i + 1);
    }
  }
  /// Quick if offsets grow from call to call: columns are counted on from the last one's.
  std::string place(std::string_view name, std::size_t offset) {
    offset = std::min(offset, text_.size());
    const auto line = std::upper_bound(starts_.begin(), starts_.end(), offset) - 1;
    if (*line > last_ || offset < last_) {
      last_ = *line;
      column_ = 1;
    }
    column_ += std::count_if(text_.begin() + static_cast<std::ptrdiff_t>(last_),
                             text_.begin() + static_cast<std::ptrdiff_t>(offset), startsCharacter);
    last_ = offset;
    return fmt::format("{}:{}:{}", name, line - starts_.begin() + 1, column_);
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_{0};
  std::size_t last_ = 0;       ///< offset asked for last
  std::ptrdiff_t column_ = 1;  ///< its column
};

/// Follows the parser through the text, token by token, since its events carry no position. Only
/// called with text that the parser has already accepted.
class TokenCursor {
 public:
  explicit TokenCursor(std::string_view text) : text_{text} {}

  /// Start of the next token, passing over it.
  std::size_t next() {
    skipBetweenTokens();
    const std::size_t start = offset_;
    skipToken();
    return start;
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return offset_ + ahead < text_.size() ? text_[offset_ + ahead] : '\0';
  }

  void skipBetweenTokens() {
    while (offset_ < text_.size()) {
      if (peek() == '/' && peek(1) == '/') {
        offset_ = std::min(text_.find('\n', offset_), text_.size());
      } else if (peek() == '/' && peek(1) == '*') {
        offset_ = std::min(text_.find("*/", offset_ + 2), text_.size() - 2) + 2;
      } else if (std::string_view{" \t\r\n,:"}.find(peek()) != std::string_view::npos) {
        ++offset_;
      } else {
        return;
      }
    }
  }

  void skipToken() {
    const char first = peek();
    ++offset_;
    if (first == '"') {
      while (offset_ < text_.size() && peek() != '"') offset_ += peek() == '\\' ? 2u : 1u;
      ++offset_;
    } else if (std::string_view{"{}[]"}.find(first) == std::string_view::npos) {
      offset_ = std::min(text_.find_first_of(" \t\r\n,:]}/", offset_), text_.size());
    }
  }

  std::string_view text_;
  std::size_t offset_ = 0;
};

/// Builds the tree from the parser's events.
class TreeBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(std::string_view text, std::string_view name)
      : name_{name}, lines_{text}, cursor_{text} {}

  Node take() { return std::move(root_); }

  bool null() override { return add(Node::Kind::kNull), true; }
  bool boolean(bool value) override { return add(Node::Kind::kBoolean).boolean = value, true; }
  bool number_integer(std::int64_t value) override { return addNumber(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override {
    return addNumber(static_cast<double>(value));
  }
  bool number_float(double value, const std::string&) override { return addNumber(value); }
  bool string(std::string& value) override {
    add(Node::Kind::kText).text = std::move(value);
    return true;
  }
  bool binary(nlohmann::json::binary_t&) override { return false; }  // no such thing in text

  bool start_object(std::size_t) override { return open(Node::Kind::kObject); }
  bool start_array(std::size_t) override { return open(Node::Kind::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    std::string where = nextPlace();
    if (!names_.back().insert(name).second) {
      At::failAt(where, "", fmt::format("'{}' stands twice in one object", name));
    }
    open_.back()->members.push_back({std::move(name), std::move(where), {}});
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    const std::string_view message = error.what();
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while …"
    const std::string_view start = message.find("] parse error at ") != message.npos ? ": " : "] ";
    const std::size_t at = message.find(start);
    At::failAt(lines_.place(name_, position == 0 ? 0 : position - 1), "",
               message.substr(at == message.npos ? 0 : at + 2));
  }

 private:
  std::string nextPlace() { return lines_.place(name_, cursor_.next()); }

  Node& add(Node::Kind kind) {
    Node* node = &root_;
    if (!open_.empty()) {
      Node& parent = *open_.back();
      node = parent.kind == Node::Kind::kObject ? &parent.members.back().value
                                                : &parent.items.emplace_back();
    }
    node->kind = kind;
    node->where = nextPlace();
    return *node;
  }
  bool addNumber(double value) { return add(Node::Kind::kNumber).number = value, true; }
  bool open(Node::Kind kind) {
    Node& node = add(kind);
    if (open_.size() == kDeepestNesting) At::failAt(node.where, "", "nested too deeply");
    open_.push_back(&node);
    names_.emplace_back();
    return true;
  }
  bool close() {
    cursor_.next();
    open_.pop_back();
    names_.pop_back();
    return true;
  }

  std::string name_;
  Lines lines_;
  TokenCursor cursor_;
  Node root_;
  std::vector<Node*> open_;  // a parent does not grow while its child is open, so these stay valid
  std::vector<std::set<std::string>> names_;  // keys so far of each open value
};

}  // namespace

const Node* Node::find(std::string_view name) const {
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.name == name; });
  return found == members.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view name) {
  return const_cast<Node*>(std::as_const(*this).find(name));
}

Node read(std::string_view text, std::string_view name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  TreeBuilder builder{text, name};
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder,
                            nlohmann::json::input_format_t::json, true, true);
  return builder.take();
}

At At::item(std::size_t index) const {
  return {node.items[index], fmt::format("{}[{}]", path, index)};
}

At At::member(const Member& member) const {
  return {member.value, childPath(path, member.name)};
}

void At::failAt(std::string_view where, std::string_view path, std::string_view message) {
  std::string line = path.empty() ? fmt::format("{}: {}", where, message)
                                  : fmt::format("{}: {}: {}", where, path, message);
  // Names and values are the file's; a message stays one line whatever they hold.
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  throw Error{ExitCode::kUsage, line};
}

std::string childPath(std::string_view path, std::string_view name) {
  return path.empty() ? std::string{name} : fmt::format("{}.{}", path, name);
}

namespace {

/// The beginning of a long text, cut between characters.
std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 0 && !startsCharacter(text[end])) --end;
  return text.substr(0, end) + "…";
}

}  // namespace

std::string shown(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return "null";
    case Node::Kind::kBoolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::kNumber:
      return fmt::format("{}", node.number);
    case Node::Kind::kText:
      return fmt::format("\"{}\"", shortened(node.text));
    case Node::Kind::kList:
      return "a list";
    case Node::Kind::kObject:
      return "an object";
  }
  return "";
}

}  // namespace burin::json
