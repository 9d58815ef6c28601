#include "burin/compositor/schedule_radices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "burin/common/error.hpp"

namespace burin::compositor {

namespace {

constexpr int kAllSwap = 13;         // up to here one round of a prime count beats everything else
constexpr int kLargestSpread = 16;   // messages that one of the rest may have to send
constexpr double kUsualRadix = 8.0;  // of radix-k
constexpr int kLargestRadix = 16;

/// Prime factors, largest first.
std::vector<int> primeFactors(int number) {
  std::vector<int> primes;
  for (int prime = 2; prime * prime <= number; ++prime) {
    for (; number % prime == 0; number /= prime) primes.push_back(prime);
  }
  if (number > 1) primes.push_back(number);
  std::ranges::sort(primes, std::greater{});
  return primes;
}

/// Up to 7: smooth counts are dense enough then, and a round still has 6 messages at most.
bool hasSmallFactors(int number) {
  for (const int prime : {2, 3, 5, 7}) {
    while (number % prime == 0) number /= prime;
  }
  return number == 1;
}

/// Radices of about the same size, largest first.
std::vector<int> inRounds(int base, std::size_t rounds) {
  std::vector<int> radices(rounds, 1);
  for (const int prime : primeFactors(base)) *std::ranges::min_element(radices) *= prime;
  std::ranges::sort(radices, std::greater{});
  return radices;
}

bool isSpreadWidely(int base, int rest) {
  return rest > 0 && base > kAllSwap && base > rest * kLargestSpread;
}

}  // namespace

int swapBase(int participants) {
  BURIN_CHECK(participants >= 1);
  if (participants <= kAllSwap) return participants;
  int base = participants;
  while (!hasSmallFactors(base) || isSpreadWidely(base, participants - base)) --base;
  return base;
}

std::vector<int> binarySwapRadices(int participants) {
  return primeFactors(swapBase(participants));
}

std::vector<int> defaultRadices(int participants) {
  const int base = swapBase(participants);
  if (base == 1) return {};
  auto rounds = static_cast<std::size_t>(std::ceil(std::log(base) / std::log(kUsualRadix) - 1e-9));
  std::vector<int> radices = inRounds(base, rounds);
  while (std::ranges::max(radices) > kLargestRadix) radices = inRounds(base, ++rounds);
  return radices;
}

std::vector<int> fittedRadices(const std::vector<int>& wished, int participants) {
  BURIN_CHECK(participants >= 1);
  std::vector<int> radices;
  int product = 1;
  for (const int radix : wished) {
    BURIN_CHECK(radix >= 2);
    if (radix > participants / product) break;
    radices.push_back(radix);
    product *= radix;
  }
  if (participants / product >= 2) radices.push_back(participants / product);
  return radices;
}

}  // namespace burin::compositor
