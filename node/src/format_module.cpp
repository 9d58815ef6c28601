// The module with HDF5 and DCMTK in it; see format_module.hpp.
#include "format_module.hpp"

#include "dicom_volume.hpp"
#include "hdf5_volume.hpp"

using burin::VolumeChoice;
using burin::node::BrickSource;

extern "C" {

BrickSource* burinOpenHdf5(const VolumeChoice& choice) {
  return burin::node::openHdf5Volume(choice).release();
}

void burinScanDicom(const VolumeChoice& choice, std::string& scan) {
  scan = burin::node::scanDicomVolume(choice);
}

BrickSource* burinOpenDicom(const VolumeChoice& choice, const std::string& scan) {
  return burin::node::openDicomVolume(choice, scan).release();
}
}
