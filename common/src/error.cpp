#include "burin/common/error.hpp"

#include <system_error>

namespace burin {

std::string systemText(int code) {
  return std::generic_category().message(code);
}

void detail::checkFailed(const char* file, int line, const char* expression,
                         const std::string& values) {
  throw std::logic_error{
      values.empty() ? fmt::format("{}:{}: expected {}", file, line, expression)
                     : fmt::format("{}:{}: expected {}, got {}", file, line, expression, values)};
}

}  // namespace burin
