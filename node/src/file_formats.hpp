#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// What is looked at to tell a file's format.
struct FileStart {
  std::string lowerName;         ///< file name in lower case, without folders
  std::vector<std::byte> bytes;  ///< the first ones, inflated if the file is gzip; at most 1024
  bool hasDims = false;          ///< the user gave dims, as for a bare raw file
  bool isFolder = false;         ///< no bytes then
  std::filesystem::path path;

  bool nameEndsWith(std::string_view suffix) const { return lowerName.ends_with(suffix); }
  bool startsWith(std::string_view text, std::size_t at = 0) const;
};

/// A file format: one reader, one line in the table.
struct FileFormat {
  std::string_view name;
  std::string_view extensions;  ///< as messages list them
  bool selfDescribing;          ///< false: takes dims, type and endian from the user
  bool (*recognises)(const FileStart& start);
  std::unique_ptr<BrickSource> (*open)(const VolumeChoice& choice);
  /// For volumes in many files: what their headers say, for openScanned() on every rank.
  std::string (*scan)(const VolumeChoice& choice) = nullptr;
  std::unique_ptr<BrickSource> (*openScanned)(const VolumeChoice& choice,
                                              const std::string& scan) = nullptr;
};

/// In the order in which they are asked.
std::span<const FileFormat> fileFormats();

/// The file in "FILE:/path", as datasets in HDF5 files are named; what was written if it is not
/// that.
std::string hdf5File(const std::string& written);

/// Whether the name stands for numbered pictures, "slice%03d.png".
bool isPicturePattern(const std::string& written);

// The readers, one file each.
bool recognisesNrrd(const FileStart& start);
std::unique_ptr<BrickSource> openNrrd(const VolumeChoice& choice);
bool recognisesNifti(const FileStart& start);
std::unique_ptr<BrickSource> openNifti(const VolumeChoice& choice);
bool recognisesMetaImage(const FileStart& start);
std::unique_ptr<BrickSource> openMetaImage(const VolumeChoice& choice);
bool recognisesVtk(const FileStart& start);
std::unique_ptr<BrickSource> openVtk(const VolumeChoice& choice);
bool recognisesVti(const FileStart& start);
std::unique_ptr<BrickSource> openVti(const VolumeChoice& choice);
bool recognisesHdf5(const FileStart& start);
std::unique_ptr<BrickSource> openHdf5(const VolumeChoice& choice);
bool recognisesPictures(const FileStart& start);
std::unique_ptr<BrickSource> openPictures(const VolumeChoice& choice);
bool recognisesDicom(const FileStart& start);
std::unique_ptr<BrickSource> openDicom(const VolumeChoice& choice);
std::string scanDicom(const VolumeChoice& choice);
std::unique_ptr<BrickSource> openScannedDicom(const VolumeChoice& choice, const std::string& scan);
bool recognisesRaw(const FileStart& start);
std::unique_ptr<BrickSource> openRaw(const VolumeChoice& choice);

}  // namespace burin::node
