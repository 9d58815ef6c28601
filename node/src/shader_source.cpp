#include "shader_source.hpp"

#include <algorithm>
#include <charconv>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

constexpr std::string_view kInclude = "#include \"";

const EmbeddedShader& findShader(std::string_view path) {
  const auto all = embeddedShaders();
  const auto found = std::ranges::find(all, path, &EmbeddedShader::path);
  if (found == all.end())
    detail::checkFailed(__FILE__, __LINE__, "shader file exists", std::string{path});
  return *found;
}

void append(ShaderSource& source, std::string_view text, std::string_view name) {
  const std::size_t number = source.files.size();
  source.files.emplace_back(name);
  const auto markLine = [&](int line) {
    if (line > 1 || number > 0) source.text += fmt::format("#line {} {}\n", line, number);
  };
  markLine(1);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view current = text.substr(0, end + 1);
    text.remove_prefix(end + 1);
    if (!current.starts_with(kInclude)) {
      source.text += current;
      continue;
    }
    const std::string_view rest = current.substr(kInclude.size());
    const std::string_view path = rest.substr(0, rest.find('"'));
    if (std::ranges::find(source.files, path) != source.files.end()) {
      source.text += '\n';
      continue;
    }
    append(source, findShader(path).text, path);
    markLine(line + 1);
  }
  if (!source.text.ends_with('\n')) source.text += '\n';
}

}  // namespace

ShaderSource expandIncludes(std::string_view text, std::string_view name) {
  ShaderSource source;
  append(source, text, name);
  return source;
}

std::string namedLog(std::string_view log, const ShaderSource& source) {
  // Mesa writes "2:17(4): error: …": source string, line, column.
  std::string named;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size() - 1);
    std::string_view line = log.substr(0, end + 1);
    log.remove_prefix(end + 1);
    std::size_t number = 0;
    const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    const auto used = static_cast<std::size_t>(rest - line.data());
    if (error == std::errc{} && used < line.size() && line[used] == ':' &&
        number < source.files.size()) {
      named += source.files[number];
      line.remove_prefix(used);
    }
    named += line;
  }
  return named;
}

}  // namespace burin::node
