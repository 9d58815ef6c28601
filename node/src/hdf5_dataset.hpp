#pragma once

#include <string>
#include <vector>

#include "hdf5_id.hpp"
#include "hdf5_name.hpp"

namespace burin::node {

/// Throws Error{kVolume} if it is no HDF5 file. HDF5's own messages are off from then on.
Hdf5File openHdf5File(const std::string& name);

/// The one that `name` means, or the only one with three dimensions or more. Throws Error{kVolume}
/// if there is none or several of them (lists them), and if it refers to files that are not there:
/// HDF5 delivers fill values for some that are missing, and waits for ever at a FIFO.
Hdf5Dataset openHdf5Dataset(const Hdf5File& file, const Hdf5Name& name);

/// Sizes of its dimensions, slowest first; empty for a single number.
std::vector<hsize_t> hdf5Shape(const Hdf5Dataset& dataset);

}  // namespace burin::node
