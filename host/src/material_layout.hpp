#pragma once

#include <optional>

#include "burin/node/survey.hpp"

namespace burin::host {

/// What a thing lies in, by what is at the volume's faces.
enum class Surroundings {
  kDark,    ///< low values: air, water, nothing
  kBright,  ///< high values
  kNone,    ///< the faces hold what the inside holds: a field cut out of a larger one
};

/// `boundary`: the value that parts low from high ones. Blocks count half if they hold both. A
/// volume too thin to have an inside lies in the dark.
Surroundings findSurroundings(const node::BlockRanges& blocks, double boundary);

/// How much of the material above `inner` lies bare: the share of the blocks at its boundary that
/// reach below `outer`, too. Small where other material encloses it, as flesh does bone; 0 if it
/// has no boundary.
double bareShare(const node::BlockRanges& blocks, double outer, double inner);

/// Where the background ends, if it and something faint of which a histogram shows no peak (leaves,
/// thin flesh, tissue that is dark in this scan) are both below `boundary`: blocks away from
/// everything brighter whose highest values are a second group of their own, at least a fifth as
/// many as the brighter ones and at most a third of all. More would be a medium that fills the
/// volume. Values that are spread as evenly as in a field will do without a gap, if they are more
/// blocks than the brighter ones; noise, of which high values are ever rarer, will not.
std::optional<double> faintBoundary(const node::BlockRanges& blocks, double boundary);

}  // namespace burin::host
