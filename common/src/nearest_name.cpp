#include "burin/common/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace burin {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances from the part of `a` read so far
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string nameSuggestion(std::string_view unknown, std::span<const std::string_view> known) {
  if (known.empty()) return "";
  const std::string_view nearest =
      *std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
        return editDistance(unknown, a) < editDistance(unknown, b);
      });
  // A slip of the fingers changes a third of the letters at most; more is another word.
  const std::size_t limit = std::max<std::size_t>(2, std::max(unknown.size(), nearest.size()) / 3);
  if (editDistance(unknown, nearest) <= std::min(limit, nearest.size() - 1)) {
    return fmt::format("did you mean '{}'?", nearest);
  }
  return fmt::format("expected one of '{}'", fmt::join(known, "', '"));
}

}  // namespace burin
