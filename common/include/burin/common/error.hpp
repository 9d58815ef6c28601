#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace burin {

/// What the program ends with; part of the command-line contract.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 2,   ///< bad usage or a bad scene
  kVolume = 3,  ///< a volume that cannot be read
  kRank = 4,    ///< a rank failed
};

/// Every failure a user can cause or meet. The message is one line: what, where, what was expected.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error{message}, code_{code} {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// Throws Error{code} with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error{code, fmt::format(format, std::forward<Args>(args)...)};
}

/// The system's own words for a value of errno.
std::string systemText(int code);

namespace detail {
[[noreturn]] void checkFailed(const char* file, int line, const char* expression,
                              const std::string& values);
template <typename T>
std::string shown(const T& value) {
  if constexpr (fmt::is_formattable<T>::value) {
    return fmt::format("{}", value);
  } else {
    return "?";
  }
}
}  // namespace detail

}  // namespace burin

/// Our own mistakes (an index, a state). Throws std::logic_error with file, line and expression.
#define BURIN_CHECK(condition)                                                          \
  do {                                                                                  \
    if (!(condition)) ::burin::detail::checkFailed(__FILE__, __LINE__, #condition, ""); \
  } while (false)

/// BURIN_CHECK(a == b) that prints both values.
#define BURIN_CHECK_EQ(a, b)                                                                    \
  do {                                                                                          \
    const auto& burinCheckA = (a);                                                              \
    const auto& burinCheckB = (b);                                                              \
    if (!(burinCheckA == burinCheckB))                                                          \
      ::burin::detail::checkFailed(                                                             \
          __FILE__, __LINE__, #a " == " #b,                                                     \
          ::burin::detail::shown(burinCheckA) + " and " + ::burin::detail::shown(burinCheckB)); \
  } while (false)
