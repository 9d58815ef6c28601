#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcfilefo.h>

#include <filesystem>

namespace burin::node {

/// Loads what a file holds, except that long values, pixels above all, stay in the file until they
/// are asked for. @returns DCMTK's opinion of the file; what came before an error is there.
OFCondition loadDicomFile(const std::filesystem::path& file, DcmFileFormat& into);

}  // namespace burin::node
