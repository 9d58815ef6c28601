#include "dicom_file.hpp"

#include <dcmtk/oflog/oflog.h>

namespace burin::node {
namespace {

/// Longer values stay in the file.
constexpr Uint32 kLongValue = 4096;

/// DCMTK's complaints go to the standard error; ours say what is wrong.
void silence() {
  static const bool isSilent = [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    return true;
  }();
  static_cast<void>(isSilent);
}

}  // namespace

OFCondition loadDicomFile(const std::filesystem::path& file, DcmFileFormat& into) {
  silence();
  return into.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, kLongValue, ERM_autoDetect);
}

}  // namespace burin::node
