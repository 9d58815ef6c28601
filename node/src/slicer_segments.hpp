#pragma once

#include <string>
#include <utility>
#include <vector>

#include "burin/common/labels.hpp"

namespace burin::node {

/// The segments that 3D Slicer describes in a header's keys (.seg.nrrd): SegmentN_LabelValue,
/// _Name, _Color (three numbers of 0 to 1) and _Layer, N from 0 on in any order. Segments without a
/// label are left out; a colour that is none is left out alone.
std::vector<LabelInfo> slicerSegments(
    const std::vector<std::pair<std::string, std::string>>& keyValues);

}  // namespace burin::node
