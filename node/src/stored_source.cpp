#include "stored_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "burin/common/error.hpp"
#include "stored_voxels.hpp"
#include "voxel_access.hpp"

namespace burin::node {
namespace {

/// The smallest and largest number of a type.
glm::dvec2 rangeOf(StoredType type) {
  return withStoredType(type, [](auto tag) {
    using Limits = std::numeric_limits<typename decltype(tag)::Type>;
    return glm::dvec2{static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max())};
  });
}

/// The integer type that all stored numbers plus `shift` fit into, if there is one.
std::optional<VoxelType> shiftedType(const glm::dvec2& stored, double shift) {
  if (shift != std::round(shift)) return std::nullopt;
  const glm::dvec2 range = stored + shift;
  if (range.x >= 0 && range.y <= 65535) return VoxelType::kU16;
  if (range.x >= -32768 && range.y <= 32767) return VoxelType::kI16;
  return std::nullopt;
}

bool isRescaled(const Conversion& conversion) {
  return std::ranges::any_of(conversion.rescale, [](const Rescale& r) { return r != Rescale{}; });
}

VoxelType typeOf(StoredType stored, const Conversion& conversion) {
  if (!isRescaled(conversion)) return deliveredType(stored);
  const bool isFloat = stored == StoredType::kF32 || stored == StoredType::kF64;
  const Rescale& first = conversion.rescale.front();
  if (isFloat || conversion.rescale.size() > 1 || first.slope != 1) return VoxelType::kF32;
  const glm::dvec2 range = conversion.storedRange.value_or(rangeOf(stored));
  return shiftedType(range, first.intercept).value_or(VoxelType::kF32);
}

/// What the user should know of how the voxels are delivered; "" if nothing is changed.
std::string noticeOf(const VolumeInfo& info, StoredType stored, const Conversion& conversion) {
  const char* const from = storedTypeName(stored);
  const char* const to = voxelTypeName(info.type);
  if (conversion.rescale.size() > 1) {
    return fmt::format("{}: {} voxels delivered as {} (each slice has a scale of its own)",
                       info.name, from, to);
  }
  if (isRescaled(conversion)) {
    return fmt::format("{}: {} voxels delivered as {} (value = stored * {} + {})", info.name, from,
                       to, conversion.rescale.front().slope, conversion.rescale.front().intercept);
  }
  if (bytesPerNumber(stored) < 4 || stored == StoredType::kF32) return "";
  return fmt::format("{}: {} voxels delivered as {}, each rounded to 24 significant bits",
                     info.name, from, to);
}

}  // namespace

StoredSource::StoredSource(VolumeInfo info, std::unique_ptr<StoredReader> stored,
                           Conversion conversion, std::string_view encoding)
    : stored_{std::move(stored)}, conversion_{std::move(conversion)}, info_{std::move(info)} {
  const StoredLayout& layout = stored_->layout();
  BURIN_CHECK(info_.grid.dims == layout.dims);
  BURIN_CHECK(conversion_.rescale.size() == 1 ||
              conversion_.rescale.size() == static_cast<std::size_t>(layout.dims.z));
  BURIN_CHECK(conversion_.component < layout.components);
  const auto& rescale = conversion_.rescale;
  if (std::ranges::all_of(rescale, [&](const Rescale& r) { return r == rescale.front(); }))
    conversion_.rescale.resize(1);
  info_.type = typeOf(layout.type, conversion_);
  info_.components = std::max(info_.components, layout.components);
  info_.encoding = fmt::format("{} {}", encoding, storedTypeName(layout.type));
  if (const std::string more = noticeOf(info_, layout.type, conversion_); !more.empty())
    info_.notice += info_.notice.empty() ? more : "; " + more;
}

void StoredSource::load(const IndexBox& region, std::span<std::byte> out) {
  checkLoad(info_, region, out);
  const StoredLayout& layout = stored_->layout();
  const bool isAsStored =
      layout.components == 1 && !isRescaled(conversion_) &&
      storedTypeName(layout.type) == std::string_view{voxelTypeName(info_.type)};
  if (isAsStored) {
    stored_->read(region, out);
    return;
  }
  // A slice at a time: what is stored may take many times the room.
  const std::size_t sliceBytes =
      region.empty() ? 0 : out.size() / static_cast<std::size_t>(region.size().z);
  for (int z = region.lo.z; z < region.hi.z && sliceBytes > 0; ++z) {
    const IndexBox slice{{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z + 1}};
    scratch_.resize(slice.count() * layout.voxelBytes());
    stored_->read(slice, scratch_);
    const bool isOne = conversion_.rescale.size() == 1;
    convert(conversion_.rescale[isOne ? 0 : static_cast<std::size_t>(z)],
            out.subspan(static_cast<std::size_t>(z - region.lo.z) * sliceBytes, sliceBytes));
  }
}

/// The scratch voxels' component into `out`, which has info_.type.
void StoredSource::convert(const Rescale& rescale, std::span<std::byte> out) const {
  const StoredLayout& layout = stored_->layout();
  const auto stride = static_cast<std::size_t>(layout.components);
  const auto component = static_cast<std::size_t>(conversion_.component);
  withStoredType(layout.type, [&](auto fromTag) {
    using From = typename decltype(fromTag)::Type;
    withVoxelType(info_.type, [&](auto toTag) {
      using To = typename decltype(toTag)::Type;
      for (std::size_t i = 0; i < out.size() / sizeof(To); ++i) {
        const From stored = voxelAt<From>(scratch_.data(), i * stride + component);
        // Not through double where nothing is rescaled: 64-bit integers would be rounded twice.
        const To value =
            rescale == Rescale{}
                ? static_cast<To>(stored)
                : static_cast<To>(static_cast<double>(stored) * rescale.slope + rescale.intercept);
        std::memcpy(out.data() + i * sizeof value, &value, sizeof value);
      }
    });
  });
}

int chosenComponent(const VolumeChoice& choice, int components) {
  if (components == 1 && choice.component.value_or(0) == 0) return 0;
  if (!choice.component) {
    fail(ExitCode::kVolume,
         "{}: {} components per voxel (expected one: choose with --component 0 ... {})",
         choice.file, components, components - 1);
  }
  if (*choice.component < 0 || *choice.component >= components) {
    fail(ExitCode::kUsage, "{}: --component {} (expected 0 ... {})", choice.file, *choice.component,
         components - 1);
  }
  return *choice.component;
}

}  // namespace burin::node
