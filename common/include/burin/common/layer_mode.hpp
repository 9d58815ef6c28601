#pragma once

namespace burin {

/// What a layer shows of the values along a ray (two-level volume rendering: Hauser, Mroz, Bischi,
/// Gröller, "Two-level volume rendering", IEEE TVCG 7(3), 2001).
enum class LayerMode {
  kDvr,      ///< a medium: the transfer function's colour and extinction along the ray
  kIso,      ///< a surface: where the volume is Layer::isoValue
  kMip,      ///< a projection: the transfer function's colour and opacity of the largest value
  kAverage,  ///< a projection: those of the values' mean
};

/// "dvr", "iso", "mip", "average", as in scene files.
constexpr const char* name(LayerMode mode) {
  switch (mode) {
    case LayerMode::kDvr:
      break;
    case LayerMode::kIso:
      return "iso";
    case LayerMode::kMip:
      return "mip";
    case LayerMode::kAverage:
      return "average";
  }
  return "dvr";
}

/// Whether the layer is one value per ray, without a place on it.
constexpr bool isProjection(LayerMode mode) {
  return mode == LayerMode::kMip || mode == LayerMode::kAverage;
}

}  // namespace burin
