#include "chessboard_distance.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

using Row = std::vector<std::uint8_t>;
constexpr std::uint8_t kLargest = kLargestDistance;

constexpr std::size_t kReach = 32;  ///< cells beside a row that spreadRow() looks at

/// The smaller of two rows, cell by cell. Here and below: loops whose cells do not depend on each
/// other, with nothing but local variables, so that the compiler vectorises them.
void takeMinimum(const std::uint8_t* from, std::uint8_t* to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) to[x] = from[x] < to[x] ? from[x] : to[x];
}

/// One further than the nearest of three cells, where that is nearer. `before`: from the cell left
/// of the first to the one right of the last.
void stepFrom(const std::uint8_t* before, std::uint8_t* cells, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint8_t sides = before[x] < before[x + 2] ? before[x] : before[x + 2];
    const std::uint8_t nearest = before[x + 1] < sides ? before[x + 1] : sides;
    const auto further = static_cast<std::uint8_t>(nearest + 1);
    cells[x] = further < cells[x] ? further : cells[x];
  }
}

/// Distances along a row from both ends, by steps of 1, 2, 4 … 32 cells, which make all up to 63.
/// `row`, `next`: kReach cells more at each end, kLargest there; the result is in `row`.
void spreadRow(Row& row, Row& next, std::size_t width) {
  for (std::size_t step = 1; step <= kReach; step *= 2) {
    const std::uint8_t* const own = row.data() + kReach;
    const std::uint8_t* const left = own - step;
    const std::uint8_t* const right = own + step;
    std::uint8_t* const to = next.data() + kReach;
    const auto further = static_cast<std::uint8_t>(step);
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t nearer = left[x] < right[x] ? left[x] : right[x];
      const auto there = static_cast<std::uint8_t>(nearer + further);
      to[x] = there < own[x] ? there : own[x];
    }
    std::swap(row, next);
  }
}

/// Distances to the nearest 0 of a grid: along x, then in two scans over the rows (Rosenfeld and
/// Pfaltz, "Distance functions on digital pictures", 1968), each of which takes a row one further
/// than the nearest neighbours in the rows that it met before.
class Scans {
 public:
  /// `cells`: 0 where the distance is 0, else kLargest; becomes the distances.
  Scans(Row& cells, const glm::ivec3& size)
      : cells_{cells}, size_{size}, width_{static_cast<std::size_t>(size.x)} {}

  void run() {
    spreadRows();
    for (int z = 0; z < size_.z; ++z)
      for (int y = 0; y < size_.y; ++y) visit(y, z, -1);
    for (int z = size_.z - 1; z >= 0; --z)
      for (int y = size_.y - 1; y >= 0; --y) visit(y, z, 1);
  }

 private:
  std::uint8_t* at(int y, int z) {
    return cells_.data() + (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) +
                            static_cast<std::size_t>(y)) *
                               width_;
  }

  void spreadRows() {
    Row row(width_ + 2 * kReach, kLargest);
    Row next = row;
    for (std::size_t first = 0; first < cells_.size(); first += width_) {
      std::copy_n(cells_.data() + first, width_, row.data() + kReach);
      spreadRow(row, next, width_);
      std::copy_n(row.data() + kReach, width_, cells_.data() + first);
    }
  }

  /// `back`: where the rows lie that were met before, -1 or 1.
  void visit(int y, int z, int back) {
    before_.assign(width_ + 2, kLargest);
    const auto take = [&](int otherY, int otherZ) {
      if (otherY < 0 || otherY >= size_.y || otherZ < 0 || otherZ >= size_.z) return;
      takeMinimum(at(otherY, otherZ), before_.data() + 1, width_);
    };
    take(y + back, z);
    for (const int dy : {-1, 0, 1}) take(y + dy, z + back);
    stepFrom(before_.data(), at(y, z), width_);
  }

  Row& cells_;
  glm::ivec3 size_;
  std::size_t width_;
  Row before_;  ///< nearest of the rows met before; one cell more at each end
};

}  // namespace

std::vector<std::uint8_t> chessboardDistance(std::span<const std::uint8_t> marked,
                                             const glm::ivec3& size) {
  BURIN_CHECK_EQ(marked.size(), static_cast<std::size_t>(size.x) *
                                    static_cast<std::size_t>(size.y) *
                                    static_cast<std::size_t>(size.z));
  Row distances(marked.size());
  for (std::size_t i = 0; i < marked.size(); ++i) distances[i] = marked[i] != 0 ? 0 : kLargest;
  Scans{distances, size}.run();
  return distances;
}

}  // namespace burin::node
