#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "random_pixels.hpp"

namespace burin::compositor::test {

/// A level of each factor.
using Levels = std::vector<int>;

/// Which pairs of levels of two factors have been met.
class PairTable {
 public:
  explicit PairTable(const Levels& counts) {
    for (const int count : counts) {
      begin_.push_back(total_);
      total_ += static_cast<std::size_t>(count);
    }
    isMet_.assign(total_ * total_, false);
  }
  bool isMet(std::size_t f, int a, std::size_t g, int b) const { return isMet_[index(f, a, g, b)]; }
  void meet(const Levels& row) {
    for (std::size_t f = 0; f < row.size(); ++f) {
      for (std::size_t g = 0; g < row.size(); ++g) isMet_[index(f, row[f], g, row[g])] = true;
    }
  }

 private:
  std::size_t index(std::size_t f, int a, std::size_t g, int b) const {
    return (begin_[f] + static_cast<std::size_t>(a)) * total_ + begin_[g] +
           static_cast<std::size_t>(b);
  }
  std::vector<std::size_t> begin_;
  std::size_t total_ = 0;
  std::vector<bool> isMet_;
};

/// Makes rows in which every level of every factor meets every level of every other one: each row
/// takes a pair that no row has yet and is then filled greedily; of a few such rows the one with
/// most new pairs stays. The same for the same arguments.
class AllPairs {
 public:
  using Allowed = std::function<bool(const Levels&)>;

  /// `counts`: levels of each factor. `isAllowed` is asked of rows whose open factors have level 0;
  /// if it refuses a row it must refuse those with higher levels, and no pair of levels may be
  /// refused by itself.
  AllPairs(Levels counts, Allowed isAllowed, unsigned seed)
      : counts_{std::move(counts)}, isAllowed_{std::move(isAllowed)}, random_{seed} {}

  std::vector<Levels> rows() {
    PairTable table{counts_};
    std::vector<Levels> rows;
    for (auto open = openPairs(table); !open.empty(); open = openPairs(table)) {
      constexpr int kTries = 20;
      Levels best;
      int most = 0;
      for (int i = 0; i < kTries; ++i) {
        const Levels row = grown(open[pick(open.size())], table);
        const int found = newPairs(row, table);
        if (found > most) {
          most = found;
          best = row;
        }
      }
      if (most == 0) throw std::logic_error{"a pair of levels is not allowed"};
      table.meet(best);
      rows.push_back(std::move(best));
    }
    return rows;
  }

 private:
  static constexpr int kOpen = -1;

  std::size_t pick(std::size_t bound) {
    return static_cast<std::size_t>(below(random_, static_cast<int>(bound)));
  }

  /// Rows with two levels each, all others open.
  std::vector<Levels> openPairs(const PairTable& table) const {
    std::vector<Levels> open;
    for (std::size_t f = 0; f < counts_.size(); ++f) {
      for (std::size_t g = f + 1; g < counts_.size(); ++g) {
        for (int a = 0; a < counts_[f]; ++a) {
          for (int b = 0; b < counts_[g]; ++b) {
            if (table.isMet(f, a, g, b)) continue;
            Levels row(counts_.size(), kOpen);
            row[f] = a;
            row[g] = b;
            open.push_back(std::move(row));
          }
        }
      }
    }
    return open;
  }

  bool isPossible(Levels row) const {
    std::ranges::replace(row, kOpen, 0);
    return isAllowed_(row);
  }

  /// Fills the open factors in a random sequence, each with the level that meets most.
  Levels grown(Levels row, const PairTable& table) {
    std::vector<std::size_t> open;
    for (std::size_t f = 0; f < row.size(); ++f) {
      if (row[f] == kOpen) open.insert(open.begin() + static_cast<int>(pick(open.size() + 1)), f);
    }
    for (const std::size_t f : open) {
      int best = 0;
      int most = -1;
      const int first = below(random_, counts_[f]);  // of equals not always the lowest
      for (int i = 0; i < counts_[f]; ++i) {
        row[f] = (first + i) % counts_[f];
        const int found = isPossible(row) ? newPairs(row, table) : -1;
        if (found > most) {
          most = found;
          best = row[f];
        }
      }
      row[f] = best;
    }
    return row;
  }

  /// 0 for rows that are not allowed.
  int newPairs(const Levels& row, const PairTable& table) const {
    int found = 0;
    for (std::size_t f = 0; f < row.size(); ++f) {
      for (std::size_t g = f + 1; g < row.size(); ++g) {
        if (row[f] != kOpen && row[g] != kOpen && !table.isMet(f, row[f], g, row[g])) ++found;
      }
    }
    return isPossible(row) ? found : 0;
  }

  Levels counts_;
  Allowed isAllowed_;
  Random random_;
};

}  // namespace burin::compositor::test
