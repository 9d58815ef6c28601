#include "first_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace burin::host {

namespace {

/// Which of the volume's blocks can show, and which of those lie at a boundary.
class VisibleMass {
 public:
  VisibleMass(const Scene& scene, const VolumeFacts& facts, const node::BlockRanges& blocks)
      : blocks_{blocks}, cells_{facts.grid.cells()} {
    mass_.reserve(blocks.lowest.size());
    for (std::size_t i = 0; i < blocks.lowest.size(); ++i) {
      double extinction = 0;
      bool isWhole = false;
      for (const Layer& layer : scene.layers) {
        const TransferFunction& function = layer.transferFunction;
        const double unit = function.opacityUnitLength.value_or(1);
        const double lowest = double{blocks.lowest[i]};
        const double highest = double{blocks.highest[i]};
        extinction += function.largestExtinction(lowest, highest, unit);
        isWhole = isWhole || (function.classify(lowest, unit).extinction > 0 &&
                              function.classify(highest, unit).extinction > 0);
      }
      mass_.push_back(extinction > 0 ? 1 : 0);
      isBoundary_.push_back(extinction > 0 && !isWhole);
    }
  }

  double at(const glm::ivec3& block) const { return mass_[blocks_.index(block)]; }

  /// How many blocks show at the lower and at the upper end of what shows along an axis.
  glm::dvec2 atEnds(int axis) const {
    constexpr double kEnd = 0.08;  // of its length
    const IndexBox shown = bounds();
    const double end = kEnd * shown.size()[axis];
    glm::dvec2 count{0};
    forBlocks([&](const glm::ivec3& block) {
      const int from = block[axis] * blocks_.blockCells;
      const int to = from + blocks_.blockCells;
      if (from <= shown.lo[axis] + end) count[0] += at(block);
      if (to >= shown.hi[axis] - end) count[1] += at(block);
    });
    return count;
  }

  /// How many blocks of each layer along an axis show, of those between the ends of what shows.
  std::vector<double> layers(int axis) const {
    const IndexBox shown = bounds();
    const int first = shown.lo[axis] / blocks_.blockCells;
    const int last = (shown.hi[axis] - 1) / blocks_.blockCells;
    std::vector<double> counts(static_cast<std::size_t>(last - first) + 1);
    forBlocks([&](const glm::ivec3& block) {
      if (at(block) > 0) counts[static_cast<std::size_t>(block[axis] - first)] += 1;
    });
    return counts;
  }

  /// Share of the blocks at the volume's lower and at its upper face along an axis that show.
  glm::dvec2 atFaces(int axis) const {
    glm::dvec2 count{0};
    forBlocks([&](const glm::ivec3& block) {
      if (block[axis] == 0) count[0] += at(block);
      if (block[axis] == blocks_.blocks[axis] - 1) count[1] += at(block);
    });
    const double area = static_cast<double>(blocks_.lowest.size()) / blocks_.blocks[axis];
    return count / area;
  }

  /// The smallest box of cells around every block that can show; the whole volume if none can.
  IndexBox bounds() const {
    IndexBox box{cells_, glm::ivec3{0}};
    forBlocks([&](const glm::ivec3& block) {
      if (!(at(block) > 0)) return;
      box.lo = glm::min(box.lo, block * blocks_.blockCells);
      box.hi = glm::max(box.hi, glm::min((block + 1) * blocks_.blockCells, cells_));
    });
    return box.empty() ? IndexBox{glm::ivec3{0}, cells_} : box;
  }

  /// Calls visit(box of cells) for the first and the last block that can show of every row of
  /// blocks along x, beyond which nothing shows; for the whole volume if nothing can.
  template <typename Visit>
  void forRowEnds(Visit&& visit) const {
    const auto cellsOf = [&](const glm::ivec3& block) {
      return IndexBox{block * blocks_.blockCells,
                      glm::min((block + 1) * blocks_.blockCells, cells_)};
    };
    bool shows = false;
    for (int z = 0; z < blocks_.blocks.z; ++z)
      for (int y = 0; y < blocks_.blocks.y; ++y) {
        int first = 0;
        while (first < blocks_.blocks.x && !(at({first, y, z}) > 0)) ++first;
        if (first == blocks_.blocks.x) continue;
        int last = blocks_.blocks.x - 1;
        while (!(at({last, y, z}) > 0)) --last;
        visit(cellsOf({first, y, z}));
        visit(cellsOf({last, y, z}));
        shows = true;
      }
    if (!shows) visit(bounds());
  }

  /// Correlation of the mass with its mirror image across the plane through its centre that is
  /// normal to `axis`; 1 is symmetric.
  double symmetry(int axis) const {
    double sum = 0, moment = 0, squares = 0, products = 0;
    forBlocks([&](const glm::ivec3& block) {
      sum += at(block);
      moment += at(block) * block[axis];
      squares += at(block) * at(block);
    });
    if (!(squares > 0)) return 0;
    const auto ends = static_cast<int>(std::lround(2 * moment / sum));  // block + its mirror image
    forBlocks([&](glm::ivec3 block) {
      const double mass = at(block);
      block[axis] = ends - block[axis];
      if (block[axis] >= 0 && block[axis] < blocks_.blocks[axis]) products += mass * at(block);
    });
    return products / squares;
  }

  /// Where the centre of all boundaries lies from that of all that shows, of its length along an
  /// axis.
  double boundaryOffset(int axis) const {
    return offset(
        axis, [&](const glm::ivec3& block) { return isBoundary(block); },
        [&](const glm::ivec3& block) { return at(block) > 0; });
  }

  /// The same of solid bodies and their surfaces alone, without sheets such as tables and
  /// headrests.
  double surfaceOffset(int axis) const {
    return offset(
        axis, [&](const glm::ivec3& block) { return isSurface(block); },
        [&](const glm::ivec3& block) { return isWhole(block) || isSurface(block); });
  }

 private:
  bool isBoundary(const glm::ivec3& block) const { return isBoundary_[blocks_.index(block)]; }
  bool isWhole(const glm::ivec3& block) const { return at(block) > 0 && !isBoundary(block); }

  /// A boundary next to, also across an edge or a corner, what shows as a whole.
  bool isSurface(const glm::ivec3& block) const {
    if (!isBoundary(block)) return false;
    const glm::ivec3 lo = glm::max(block - 1, 0);
    const glm::ivec3 hi = glm::min(block + 1, blocks_.blocks - 1);
    for (int z = lo.z; z <= hi.z; ++z)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x)
          if (isWhole({x, y, z})) return true;
    return false;
  }

  /// From the centre of the blocks of `whole` to that of those of `part`, of the length of what
  /// shows along an axis; 0 if there are none.
  template <typename Part, typename Whole>
  double offset(int axis, Part&& part, Whole&& whole) const {
    glm::dvec2 all{0}, some{0};  // count, moment
    forBlocks([&](const glm::ivec3& block) {
      const glm::dvec2 one{1, block[axis]};
      if (whole(block)) all += one;
      if (part(block)) some += one;
    });
    if (!(some[0] > 0)) return 0;
    const double length = static_cast<double>(bounds().size()[axis]) / blocks_.blockCells;
    return (some[1] / some[0] - all[1] / all[0]) / length;
  }

  template <typename Visit>
  void forBlocks(Visit&& visit) const {
    for (int z = 0; z < blocks_.blocks.z; ++z)
      for (int y = 0; y < blocks_.blocks.y; ++y)
        for (int x = 0; x < blocks_.blocks.x; ++x) visit(glm::ivec3{x, y, z});
  }

  const node::BlockRanges& blocks_;
  glm::ivec3 cells_;
  std::vector<double> mass_;
  std::vector<bool> isBoundary_;
};

/// Whether the camera at azimuth 0 would look at the back: faces have more surface than backs of
/// heads.
bool isTurnedAway(const VisibleMass& mass, bool isUpZ) {
  constexpr double kLeast = 0.005;
  // The eye is at low y if z is up, and at high z if y is.
  return isUpZ ? mass.surfaceOffset(1) > kLeast : mass.surfaceOffset(2) < -kLeast;
}

bool isLeftRightSymmetric(const VisibleMass& mass) {
  constexpr double kSymmetric = 0.93;
  constexpr double kMore = 0.03;
  const double leftRight = mass.symmetry(0);
  return leftRight > kSymmetric && leftRight > std::max(mass.symmetry(1), mass.symmetry(2)) + kMore;
}

/// Whether what shows stands on, or hangs from, what covers one of the volume's faces along z.
bool hasFloorAlongZ(const VisibleMass& mass) {
  constexpr double kCovered = 0.4;
  constexpr double kMore = 2;
  const glm::dvec2 faces = mass.atFaces(2);
  const glm::dvec2 sides = glm::max(mass.atFaces(0), mass.atFaces(1));
  const double rest = std::max({std::min(faces[0], faces[1]), sides[0], sides[1]});
  const double floor = std::max(faces[0], faces[1]);
  return floor > kCovered && floor > kMore * rest;
}

/// Whether a sheet, such as the table under a scan, lies above all that shows but for specks.
bool isSheetAbove(const VisibleMass& mass, int upAxis) {
  constexpr double kWider = 2;      // than each layer below
  constexpr double kSpecks = 0.05;  // of all
  constexpr std::ptrdiff_t kThick = 3;
  const std::vector<double> layers = mass.layers(upAxis);
  const auto third = static_cast<std::ptrdiff_t>(layers.size() / 3);
  if (third <= kThick) return false;
  const auto sheet = std::max_element(layers.end() - third, layers.end());
  const double widestBelow = *std::max_element(layers.begin(), sheet - kThick);
  const auto above = layers.end() - sheet > kThick ? sheet + kThick : layers.end();
  return *sheet > kWider * widestBelow &&
         std::accumulate(above, layers.end(), 0.0) <
             kSpecks * std::accumulate(layers.begin(), layers.end(), 0.0);
}

/// By what the upper face cuts off, and by tables; of heads also by the face, which has more
/// boundaries than the vault of the skull above it.
bool isUpsideDown(const VisibleMass& mass, int upAxis, int cells) {
  constexpr double kMore = 1.25;
  constexpr double kFaceAbove = 0.014;
  constexpr double kNoFace = 0.03;  // so far up it is not for a face
  const glm::dvec2 ends = mass.atEnds(upAxis);
  if (mass.bounds().hi[upAxis] == cells && ends[1] > kMore * ends[0]) return true;
  if (isSheetAbove(mass, upAxis)) return true;
  const double offset = mass.boundaryOffset(upAxis);
  return isLeftRightSymmetric(mass) && offset > kFaceAbove && offset < kNoFace;
}

/// The same view of what is upside down: beyond the pole, from where the up axis points down.
void turnOver(CameraChoice& camera) {
  camera.azimuthDeg += 180;
  camera.elevationDeg = camera.elevationDeg - 180;
}

/// As scans are, whose slices are seldom as far apart as their pixels.
bool isAnisotropic(const glm::dvec3& spacing) {
  constexpr double kDifferent = 1.01;
  const double smallest = std::min({spacing.x, spacing.y, spacing.z});
  return std::max({spacing.x, spacing.y, spacing.z}) > kDifferent * smallest;
}

bool isFlat(const glm::dvec3& extent) {
  constexpr double kFlat = 0.4;
  return extent.z < kFlat * std::min(extent.x, extent.y);
}

/// How far a box of so many cells reaches along the world's axes.
glm::dvec3 worldExtent(const VolumeGrid& grid, const glm::ivec3& cells) {
  const glm::dmat3 steps = grid.indexToWorld();
  return glm::abs(steps[0]) * double(cells.x) + glm::abs(steps[1]) * double(cells.y) +
         glm::abs(steps[2]) * double(cells.z);
}

/// The magnification at which all that can show just fits the picture.
double zoomToFit(const Scene& scene, const VolumeFacts& facts, const VisibleMass& mass) {
  constexpr double kFilled = 0.94;  // of the picture's half sides
  constexpr double kLargest = 20;
  const Camera camera = resolveCamera(scene, facts);
  const bool isPerspective = camera.projection == Projection::kPerspective;
  double farthest = 0;
  mass.forRowEnds([&](const IndexBox& cells) {
    const Box box = facts.grid.cellBoxIndex(cells);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::bvec3 upper{(corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0};
      const glm::dvec3 offset =
          facts.grid.worldFromIndex(glm::mix(box.lo, box.hi, upper)) - camera.eyeWorld;
      const double depth = isPerspective ? glm::dot(offset, camera.forward) : 1;
      const double x = glm::dot(offset, camera.right) / depth / camera.image.width;
      const double y = glm::dot(offset, camera.up) / depth / camera.image.height;
      farthest = std::max({farthest, std::abs(x), std::abs(y)});
    }
  });
  const double fitting = kFilled * camera.pixelSize / 2 / farthest;
  return std::clamp(std::floor(20 * fitting) / 20, 0.5, kLargest);  // a number that people can read
}

}  // namespace

CameraChoice firstView(const Scene& scene, const VolumeFacts& facts,
                       const node::BlockRanges& blocks) {
  constexpr double kElongated = 1.5;
  const VisibleMass mass{scene, facts, blocks};
  const glm::dvec3 extent = worldExtent(facts.grid, mass.bounds().size());
  Scene viewed = scene;
  CameraChoice& camera = viewed.camera;
  const bool isFlatBox = isFlat(glm::dvec3{facts.grid.cells()} * facts.grid.spacing);
  const bool isUpZ = facts.anatomical || isFlatBox || isAnisotropic(facts.grid.spacing) ||
                     isLeftRightSymmetric(mass) || hasFloorAlongZ(mass);
  camera.upAxis = isUpZ ? "z" : "y";
  const int up = isUpZ ? 2 : 1;
  if (isFlatBox) camera.elevationDeg = 40;
  const double depth = isUpZ ? extent.y : extent.z;
  if (depth > kElongated * extent.x) camera.azimuthDeg = 60;
  if (!facts.anatomical && isTurnedAway(mass, isUpZ)) camera.azimuthDeg += 180;
  if (!facts.anatomical && isUpsideDown(mass, up, facts.grid.cells()[up])) turnOver(camera);
  camera.azimuthDeg = std::fmod(camera.azimuthDeg, 360);
  camera.zoom = zoomToFit(viewed, facts, mass);
  return camera;
}

}  // namespace burin::host
