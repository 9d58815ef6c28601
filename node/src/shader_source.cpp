#include "shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "burin/common/error.hpp"
#include "shader_conditions.hpp"

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

/// A line without its comment and the blanks at its end.
std::string_view codeOf(std::string_view line) {
  line = line.substr(0, line.find("//"));
  return line.substr(0, line.find_last_not_of(" \n") + 1);
}

void append(ShaderSource& source, ShaderConditions& conditions, std::string_view text,
            std::string_view name) {
  const std::size_t file = source.files.size();
  source.files.emplace_back(name);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view code = codeOf(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
    if (code.empty() || !conditions.keeps(code)) continue;
    if (!code.starts_with(kInclude)) {
      source.text.append(code).push_back('\n');
      source.lines.push_back({file, line});
      continue;
    }
    const std::string_view rest = code.substr(kInclude.size());
    const std::string_view path = rest.substr(0, rest.find('"'));
    if (std::ranges::find(source.files, path) == source.files.end())
      append(source, conditions, findShader(path).text, path);
  }
}

}  // namespace

ShaderSource expandIncludes(std::string_view text, std::string_view name) {
  ShaderSource source;
  ShaderConditions conditions;
  append(source, conditions, text, name);
  BURIN_CHECK(conditions.isClosed());
  return source;
}

std::string namedLog(std::string_view log, const ShaderSource& source) {
  // Mesa writes "0:17(4): error: …": source string, line, column.
  constexpr std::string_view kTheText = "0:";
  std::string named;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size() - 1);
    std::string_view line = log.substr(0, end + 1);
    log.remove_prefix(end + 1);
    if (line.starts_with(kTheText)) {
      const char* const number = line.data() + kTheText.size();
      std::size_t in = 0;
      const auto [rest, error] = std::from_chars(number, line.data() + line.size(), in);
      if (error == std::errc{} && in >= 1 && in <= source.lines.size()) {
        const ShaderSource::Place& place = source.lines[in - 1];
        named += fmt::format("{}:{}", source.files[place.file], place.line);
        line.remove_prefix(static_cast<std::size_t>(rest - line.data()));
      }
    }
    named += line;
  }
  return named;
}

}  // namespace burin::node
