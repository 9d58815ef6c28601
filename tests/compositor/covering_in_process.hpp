#pragma once

#include "covering_rows.hpp"

namespace burin::compositor::test {

/// Composites the frame in this process, twice, and looks at pixels, outcomes and traffic. Compiled
/// once for all programs: that takes half a minute.
void expectSerialCombination(const FrameRow& row);

}  // namespace burin::compositor::test
