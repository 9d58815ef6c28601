#pragma once

#include <memory>
#include <string>

#include "hdf5_id.hpp"
#include "stored_reader.hpp"

namespace burin::node {

/// Voxels of a dataset: z, y, x as HDF5 has them, slowest first, and components if there are four
/// dimensions; leading dimensions of 1 do not count. Chunks, compressed or not, are HDF5's
/// business: any region at its own cost. `name`: in messages. Throws Error{kVolume} if the
/// dataset's type or shape is no volume's.
std::unique_ptr<StoredReader> makeHdf5Voxels(const std::string& name, Hdf5File file,
                                             Hdf5Dataset dataset);

}  // namespace burin::node
