#pragma once

#include <array>
#include <bitset>
#include <cstddef>

namespace burin {

/// How a gradient is estimated from the 3×3×3 voxels around a place. All three weigh differences
/// f(p + o) - f(p - o) over the 13 pairs of opposite neighbours, so that a linear field's gradient
/// is exact; the weights depend on the pair's distance alone.
enum class GradientOperator {
  kCentral,     ///< the six face neighbours: cheapest, shows every voxel's noise
  kSobel,       ///< 1-2-1 across: weights 4, 2, 1 for faces, edges, corners
  kRegression,  ///< the plane of least squares (Neumann et al. 2000), weights 1 / distance
};
inline constexpr std::size_t kGradientOperators = 3;

/// One value for each operator.
template <typename T>
class PerGradientOperator {
 public:
  T& operator[](GradientOperator which) { return values_[static_cast<std::size_t>(which)]; }
  const T& operator[](GradientOperator which) const {
    return values_[static_cast<std::size_t>(which)];
  }
  void fill(const T& value) { values_.fill(value); }

 private:
  std::array<T, kGradientOperators> values_{};
};

class GradientOperatorSet {
 public:
  GradientOperatorSet() = default;
  explicit GradientOperatorSet(GradientOperator only) { insert(only); }
  void insert(GradientOperator which) { has_.set(static_cast<std::size_t>(which)); }
  bool contains(GradientOperator which) const { return has_.test(static_cast<std::size_t>(which)); }
  bool contains(const GradientOperatorSet& others) const { return (others.has_ & ~has_).none(); }
  bool empty() const { return has_.none(); }
  GradientOperatorSet operator|(const GradientOperatorSet& other) const {
    GradientOperatorSet both = *this;
    both.has_ |= other.has_;
    return both;
  }

 private:
  std::bitset<kGradientOperators> has_;
};

inline constexpr std::array<GradientOperator, kGradientOperators> kAllGradientOperators{
    GradientOperator::kCentral, GradientOperator::kSobel, GradientOperator::kRegression};

}  // namespace burin
