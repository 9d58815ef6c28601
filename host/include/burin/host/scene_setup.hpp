#pragma once

#include <memory>
#include <optional>

#include "burin/common/communicator.hpp"
#include "burin/common/labels.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/command_line.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"
#include "burin/node/worker.hpp"

namespace burin::host {

/// A scene ready to be drawn, and the volume it names.
struct PreparedScene {
  Scene scene;  ///< resolved; volume.file can be opened from the working directory
  std::unique_ptr<node::BrickSource> source;
  VolumeFacts facts;
  std::optional<node::KnownSurvey> survey;    ///< if the scene was made from one
  std::unique_ptr<node::BrickSource> labels;  ///< the label volume, if the scene names one
  std::vector<LabelInfo> labelInfos;          ///< what is known of its labels
};

/// Collective. Rank 0 reads the scene file for all, every rank parses it and opens the volume; a
/// volume without a scene gets one from its histogram, or from its labels. Throws SharedError or
/// CollectiveError.
PreparedScene prepareScene(const Communicator& comm, const RenderOptions& options);

/// Collective. Opens a volume on every rank.
std::unique_ptr<node::BrickSource> openTogether(const Communicator& comm,
                                                const VolumeChoice& choice);

/// For a worker that draws that scene.
node::WorkerOptions workerOptions(const PreparedScene& prepared, node::WorkerOptions options);

/// The scene as a file at `target`: relative names of volumes become relative to that file's
/// folder.
std::string sceneTextFor(const Scene& scene, const std::filesystem::path& target);

}  // namespace burin::host
