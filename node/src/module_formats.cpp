// The formats whose readers are in a module (format_module.hpp), as the table has them.
#include "dicom_folder.hpp"
#include "file_formats.hpp"
#include "format_module.hpp"
#include "hdf5_name.hpp"
#include "module_function.hpp"

namespace burin::node {
namespace {

template <typename Function>
Function* formatFunction(const char* name) {
  return reinterpret_cast<Function*>(moduleFunction(BURIN_FORMATS_MODULE, name));
}

}  // namespace

bool recognisesHdf5(const FileStart& start) {
  using std::string_view_literals::operator""sv;
  return start.startsWith("\x89HDF\r\n\x1a\n"sv) || start.nameEndsWith(".h5") ||
         start.nameEndsWith(".hdf5");
}

std::string hdf5File(const std::string& written) {
  return splitHdf5Name(written).file;
}

std::unique_ptr<BrickSource> openHdf5(const VolumeChoice& choice) {
  return std::unique_ptr<BrickSource>{formatFunction<OpenInModule>(kOpenHdf5)(choice)};
}

bool recognisesDicom(const FileStart& start) {
  if (start.isFolder) return hasDicomFiles(start.path);
  return start.startsWith("DICM", 128) || start.nameEndsWith(".dcm");
}

std::string scanDicom(const VolumeChoice& choice) {
  std::string scan;
  formatFunction<ScanInModule>(kScanDicom)(choice, scan);
  return scan;
}

std::unique_ptr<BrickSource> openScannedDicom(const VolumeChoice& choice, const std::string& scan) {
  return std::unique_ptr<BrickSource>{
      formatFunction<OpenScannedInModule>(kOpenDicom)(choice, scan)};
}

std::unique_ptr<BrickSource> openDicom(const VolumeChoice& choice) {
  return openScannedDicom(choice, scanDicom(choice));
}

}  // namespace burin::node
