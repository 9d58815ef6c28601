#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "burin/common/transfer_function.hpp"

namespace burin::node {

/// A transfer function sampled for linear look-up: entry i of n stands at
/// first + i * (last - first) / (n - 1), in data units; the end entries hold outside.
struct TransferTable {
  double first = 0;
  double last = 1;
  std::vector<glm::vec4> entries;  ///< linear RGB, extinction per world unit

  double binWidth() const { return (last - first) / static_cast<double>(entries.size() - 1); }
};

/// Table with entries on the function's own points wherever those have a common grid, and the
/// fewest entries that keep the opacity of one unit length right to 1e-6 between them, at most
/// kLargestTransferTable. Steps (two points at one value) become one bin wide. Spans what of the
/// function's points lies within [lowest, highest], the data's values (lowest < highest).
TransferTable makeTransferTable(const TransferFunction& function, double unitLength, double lowest,
                                double highest);

inline constexpr int kLargestTransferTable = 16384;  // llvmpipe's largest one-dimensional texture

}  // namespace burin::node
