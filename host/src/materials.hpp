#pragma once

#include <optional>

#include "burin/host/material_profile.hpp"

namespace burin::host {

/// Where materials part, in data units. What is below `outer` is background (air, water, nothing).
struct Materials {
  double outer = 0;
  /// Parts a denser material within, such as bone in flesh, from what surrounds it; above `outer`.
  std::optional<double> inner;
  double around = 0;  ///< beside `inner`: the most frequent value between the two
  double top = 0;     ///< little lies above; above `outer` and `inner`
  double bottom = 0;  ///< little lies below; below `outer`
  /// Gradient magnitude within the background: noise. Of the volume's 99.9th percentile.
  double noise = 0;
};

/// The background and what lies in it parted by Otsu's threshold, then moved to where the field is
/// steepest between their most frequent values: halfway, if the boundary is blurred. The same again
/// above that, if it finds a boundary that is steeper than the material around it. If values below
/// the first boundary are a material of their own (a mode of the histogram), it is the one between
/// the background and that material that counts.
Materials findMaterials(const MaterialProfile& profile);

/// The same with a material of values from `faint` (below `outer`) around, and all that is above
/// `outer` within. `histogram`: of the profile.
Materials withFaint(const Materials& materials, double faint, const Histogram& histogram);

}  // namespace burin::host
