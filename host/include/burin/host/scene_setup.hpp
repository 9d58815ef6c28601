#pragma once

#include <memory>

#include "burin/common/communicator.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/command_line.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::host {

/// A scene ready to be drawn, and the volume it names.
struct PreparedScene {
  Scene scene;  ///< resolved; volume.file can be opened from the working directory
  std::unique_ptr<node::BrickSource> source;
  VolumeFacts facts;
};

/// Collective. Rank 0 reads the scene file for all, every rank parses it and opens the volume; a
/// volume without a scene gets one from its histogram. Throws SharedError or CollectiveError.
PreparedScene prepareScene(const Communicator& comm, const RenderOptions& options);

/// Collective. Opens a volume on every rank.
std::unique_ptr<node::BrickSource> openTogether(const Communicator& comm,
                                                const VolumeChoice& choice);

/// The scene as a file at `target`: a relative volume.file becomes relative to that file's folder.
std::string sceneTextFor(const Scene& scene, const std::filesystem::path& target);

}  // namespace burin::host
