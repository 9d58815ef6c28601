#pragma once

#include "burin/common/communicator.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host {

/// Collective. Opens the label volume of a choice beside the prepared volume, with what its file
/// and the file of names say of its labels (by the latter where both do). Throws SharedError.
void openLabels(const Communicator& comm, const LabelVolumeChoice& choice, PreparedScene& prepared);

/// Collective. Rank 0 reads a file of ITK-SNAP's label descriptions for all. Throws SharedError.
std::vector<LabelInfo> labelDescriptions(const Communicator& comm, const std::string& file);

/// Collective. Labels' names in the scene become numbers. Throws SharedError, also if layers are
/// bound to labels and there is no label volume.
void resolveLabels(const Communicator& comm, PreparedScene& prepared);

}  // namespace burin::host
