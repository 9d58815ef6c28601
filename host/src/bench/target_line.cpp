#include "bench/target_line.hpp"

#include <fmt/format.h>

namespace burin::host::bench {

namespace {

std::string line(std::string_view what, double measured, double target, bool isMet) {
  return fmt::format("  {:<52}{:>8.4f}   target {:<5} {}\n", what, measured, target,
                     isMet ? "met" : "missed");
}

}  // namespace

std::string atMostLine(std::string_view what, std::optional<double> measured, double most) {
  return measured ? line(what, *measured, most, *measured <= most) : std::string{};
}

std::string atLeastLine(std::string_view what, std::optional<double> measured, double least) {
  return measured ? line(what, *measured, least, *measured >= least) : std::string{};
}

}  // namespace burin::host::bench
