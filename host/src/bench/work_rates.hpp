#pragma once

#include "burin/common/communicator.hpp"
#include "burin/compositor/replay.hpp"
#include "burin/compositor/subimage.hpp"

namespace burin::host::bench {

/// Collective. What the compositor's own functions take per pixel and byte on one core, measured on
/// the subimage with most active pixels while the other ranks wait; the same on all ranks. Packing
/// depends on what is packed, so this is measured for each input anew. Zeros if nobody drew
/// anything.
compositor::WorkRates measureWorkRates(const Communicator& comm,
                                       const compositor::Subimage<Rgba>& mine);

}  // namespace burin::host::bench
