#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "burin/common/communicator.hpp"
#include "burin/node/survey.hpp"

namespace burin::node {

using DeliverSlab = std::function<void(const Slab&)>;

/// z slices of `sliceBytes` that fit into a slab, at least one.
int slicesPerSlab(std::size_t sliceBytes, std::size_t slabBytes);

/// The share of readSlabs for sources with random access. Local.
void readOwnSlabs(BrickSource& source, std::span<const IndexBox> boxes, const DeliverSlab& deliver,
                  std::size_t slabBytes);

/// The share of readSlabs for streams: the root reads and scatters. Matches its messages on all
/// ranks even if a read or a callback fails; collective all the same. @returns this rank's outcome.
Outcome scatterSlabs(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
                     const DeliverSlab& deliver, std::size_t slabBytes);

}  // namespace burin::node
