#include "burin/node/procedural.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/nearest_name.hpp"
#include "ct_phantom.hpp"
#include "smooth.hpp"
#include "stored_voxels.hpp"
#include "vessel_tree.hpp"
#include "voxel_access.hpp"

namespace burin::node {
namespace {

using std::numbers::pi;

/// Marschner & Lobb, "An Evaluation of Reconstruction Filters for Volume Rendering", Visualization
/// 1994, with f_M = 6 and α = 0.25, on [-1, 1]³.
double marschnerLobb(const glm::dvec3& p) {
  constexpr double kFrequency = 6;
  constexpr double kAlpha = 0.25;
  const glm::dvec3 q = p * 2.0 - 1.0;
  const double radial = std::cos(2 * pi * kFrequency * std::cos(pi * std::hypot(q.x, q.y) / 2));
  return (1 - std::sin(pi * q.z / 2) + kAlpha * (1 + radial)) / (2 * (1 + kAlpha));
}

/// sin⁴(4πr)·(1 - 0.6r²), r = 1 on the inscribed sphere: four shells, the outer ones fainter, three
/// times continuously differentiable where they end.
double shells(const glm::dvec3& p) {
  const double r = 2 * glm::length(p - 0.5);
  if (r >= 1) return 0;
  const double wave = std::sin(4 * pi * r);
  return wave * wave * wave * wave * (1 - 0.6 * r * r);
}

double homogeneous(const glm::dvec3&) {
  return 0.5;
}

double ramp(const glm::dvec3& p) {
  return p.x;
}

/// Full inside the tubes, with a wall that falls off smoothly.
double vessels(const glm::dvec3& p) {
  return smoothRamp(0.02, 0.75, VesselTree::instance().field(p));
}

/// The phantom's Hounsfield units on the scale of i16: value * 4095 - 1024.
double ctPhantom(const glm::dvec3& p) {
  return (ctPhantomHounsfield(p) + 1024) / 4095;
}

double ctPhantomLabels(const glm::dvec3& p) {
  return ctPhantomLabel(p) / 255.0;
}

constexpr std::array<ProceduralKind, 7> kKinds{{
    {"marschner-lobb", "test signal near the Nyquist frequency (Marschner & Lobb 1994)",
     marschnerLobb},
    {"shells", "four concentric spherical shells with a smooth profile", shells},
    {"homogeneous", "one half everywhere", homogeneous},
    {"ramp", "linear along x from 0 to 1", ramp},
    {"vessels", "a branching tree of smooth tubes", vessels},
    {"ct-phantom", "a head with CT-like values: skin, skull, brain, ventricles, eyes", ctPhantom,
     false, true},
    {"ct-phantom-labels",
     "its segmentation (u8): 1 soft tissue, 2 bone, 3 brain, 4 ventricles, 5 lesion, 6 eyes",
     ctPhantomLabels, true, true},
}};

const ProceduralKind& kindNamed(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ProceduralKind& kind : kKinds) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  fail(ExitCode::kUsage, "procedural volume \"{}\" is unknown; {}", name,
       nameSuggestion(name, names));
}

/// The affine map from [0, 1] to stored numbers.
struct StoredScale {
  double offset;
  double factor;
};

StoredScale scaleOf(VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return {0, 255};
    case VoxelType::kU16:
      return {0, 4095};
    case VoxelType::kI16:
      return {-1024, 4095};
    case VoxelType::kF32:
      return {0, 1};
  }
  throw std::logic_error{"voxel type out of range"};
}

/// p of index i: 0 at the first sample, 1 at the last.
std::vector<double> positions(int from, int to, int dim) {
  std::vector<double> all;
  for (int i = from; i < to; ++i) {
    all.push_back(dim > 1 ? static_cast<double>(i) / (dim - 1) : 0.5);
  }
  return all;
}

class ProceduralSource : public BrickSource {
 public:
  ProceduralSource(VolumeInfo info, const ProceduralKind& kind)
      : info_{std::move(info)}, value_{kind.value} {}
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return true; }

  void load(const IndexBox& region, std::span<std::byte> out) override {
    checkLoad(info_, region, out);
    withVoxelType(info_.type,
                  [&](auto tag) { evaluate<typename decltype(tag)::Type>(region, out.data()); });
  }

 private:
  template <typename Voxel>
  void evaluate(const IndexBox& region, std::byte* out) const {
    const StoredScale scale = scaleOf(info_.type);
    const glm::ivec3 dims = info_.grid.dims;
    const auto xs = positions(region.lo.x, region.hi.x, dims.x);
    for (const double z : positions(region.lo.z, region.hi.z, dims.z)) {
      for (const double y : positions(region.lo.y, region.hi.y, dims.y)) {
        for (const double x : xs) {
          const double number = scale.offset + value_({x, y, z}) * scale.factor;
          const auto voxel =
              static_cast<Voxel>(std::is_integral_v<Voxel> ? std::round(number) : number);
          std::memcpy(out, &voxel, sizeof voxel);
          out += sizeof voxel;
        }
      }
    }
  }

  VolumeInfo info_;
  double (*value_)(const glm::dvec3& p);
};

}  // namespace

std::span<const ProceduralKind> proceduralKinds() {
  return kKinds;
}

std::unique_ptr<BrickSource> makeProcedural(std::string_view name, const glm::ivec3& dims,
                                            VoxelType type, const glm::dvec3& spacing) {
  const ProceduralKind& kind = kindNamed(name);
  if (kind.isLabels && type != VoxelType::kU8)
    fail(ExitCode::kUsage, "procedural volume \"{}\": labels are of type u8 (found {})", name,
         voxelTypeName(type));
  VolumeInfo info;
  info.name = fmt::format("procedural {}", name);
  info.format = "procedural";
  info.type = type;
  info.grid.dims = checkedDims(info.name, {dims.x, dims.y, dims.z}, ExitCode::kUsage);
  info.grid.spacing = spacing;
  info.anatomical = kind.isAnatomical;
  if (kind.isAnatomical) info.grid.direction = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};  // in LPS
  checkGrid(info.name, info.grid, ExitCode::kUsage);
  return std::make_unique<ProceduralSource>(std::move(info), kind);
}

}  // namespace burin::node
