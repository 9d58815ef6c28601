#pragma once

#include <vector>

namespace burin::compositor {

/// Radices of binary swap among `participants` (>= 1): prime factors, largest first, of the number
/// of participants that swap, see swapBase.
std::vector<int> binarySwapRadices(int participants);

/// Radices of radix-k among `participants` (>= 1) when none are given: the same number of
/// participants swaps, in as few rounds as radices of about eight allow. With more, the messages
/// of a round cost more than the round they save; with less, the other way round.
std::vector<int> defaultRadices(int participants);

/// `wished` as far as it goes among `participants`: its longest beginning whose product is not
/// more, and one further radix if that leaves more than half of them out.
std::vector<int> fittedRadices(const std::vector<int>& wished, int participants);

/// How many of `participants` swap and own pieces in the end: all of them if they are few or their
/// count has small factors; else the nearest smaller count that has. The rest exchange among
/// themselves and send their pieces to those owners (schedule_swap.hpp).
int swapBase(int participants);

}  // namespace burin::compositor
