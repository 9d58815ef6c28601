#pragma once

#include <filesystem>

#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/common/statistics.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/picture.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host {

/// The file of frame `index`: "out.png" is numbered "out_0007.png" if there are --frames.
std::filesystem::path frameFile(const RenderOptions& options, int index);

/// Throws Error{kUsage} unless every file that this run is to write can be written and overwrites
/// neither another one nor what the command line names as input.
void checkOutputs(const RenderOptions& options);

/// Throws Error{kUsage} if two outputs (of a sequence: its first frame) are one file, or if one
/// overwrites the scene, the volume or the labels. --save-scene may replace the scene. `volume`,
/// `labels`: the files, "" if there is none.
void checkConflicts(const RenderOptions& options, const std::filesystem::path& volume,
                    const std::filesystem::path& labels);

/// What a picture of that scene in `target` says about itself.
PictureMetadata metadataFor(const Scene& scene, const RenderOptions& options,
                            const std::filesystem::path& target, double orbitDeg);

/// What rank 0 alone does with frames: the finish passes and the files. Not collective.
class Display {
 public:
  /// Throws Error{kUsage} if there is no font for annotations.
  Display(const PreparedScene& prepared, const RenderOptions& options);

  /// The finished picture in memory: background, 8 bits and annotations for PNG; the frame itself
  /// for EXR, which must stay until it is written. `camera`: what the frame was drawn with.
  void finish(ImageView<const Rgba> frame, const Camera& camera);
  /// Writes what `finish` made. Throws as writePng does.
  void write(int index, double orbitDeg) const;

 private:
  bool isExr() const;
  const PreparedScene& prepared_;
  const RenderOptions& options_;
  ImageView<const Rgba> frame_;
  DisplayPicture picture_;
};

}  // namespace burin::host
