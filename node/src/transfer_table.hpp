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
  /// Of each bin between entries: exact means of (extinction * colour, extinction), in which no
  /// point of the function is missed.
  std::vector<glm::dvec4> means;

  /// Bins between which alone the table shows anything: exactly 0 up to x, and from y on. Infinite
  /// where an end's extinction, which goes on for ever, is not 0; (0, 0) if all of it is.
  glm::dvec2 visibleBins() const;
  double binWidth() const { return (last - first) / static_cast<double>(entries.size() - 1); }
};

/// Table with entries on the function's own points wherever those have a common grid, and the
/// fewest entries that keep the opacity of one unit length right to 1e-6 between them, at most
/// kLargestTransferTable. Steps (two points at one value) become one bin wide. Spans what of the
/// function's points lies within [lowest, highest], the data's values (lowest < highest).
TransferTable makeTransferTable(const TransferFunction& function, double unitLength, double lowest,
                                double highest);

/// A table of n bins as the rows of a texture of n + 2 texels. The rows after the first are what
/// pre-integrated classification looks up (Engel et al. 2001, in one dimension): integrals over the
/// value in units of bins, from `first` on.
struct TransferRows {
  /// The entries (and the last one again).
  std::vector<glm::vec4> table;
  /// At the borders of the bins: integrals of extinction * colour, and of the extinction.
  std::vector<glm::vec4> colour;
  /// Texel i + 1 is bin i, from value i to i + 1: the integral of the extinction up to i, in two
  /// floats whose sum counts, as differences of close integrals must stay exact; the extinction at
  /// i and its rise over the bin, a line with the bin's mean. Bins -1 and n go on to either side
  /// with the ends' values.
  std::vector<glm::vec4> extinction;
};
TransferRows transferRows(const TransferTable& table);

/// With the texel that rows have more than entries, llvmpipe's largest one-dimensional texture.
inline constexpr int kLargestTransferTable = 16383;

}  // namespace burin::node
