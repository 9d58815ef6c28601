#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/compositor/subimage.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/node/worker.hpp"

namespace burin::host::bench {

/// What the ranks of a communicator are to composite.
struct CompositingInput {
  std::string name;  ///< the scene's, "dense" or "disc"
  compositor::Subimage<Rgba> mine;
  std::vector<Rank> order;    ///< front to back, the same on every rank
  double activeFraction = 0;  ///< mean over the ranks of active pixels / all pixels
};

/// A scene's name with its volume opened.
struct NamedScene {
  std::string name;
  PreparedScene prepared;
};

/// Collective. The scenes whose k-d footprints are composited: the one that the user names
/// (options.input, options.volume), else two built-in ones: "vessels", a few per cent of the frame,
/// and "ct-phantom", a translucent head. Throws as prepareScene does.
std::vector<NamedScene> benchScenes(const Communicator& comm, const RenderOptions& options);

/// Draws a scene as `burin render` does, one brick per rank of a communicator.
class SceneInput {
 public:
  /// Collective over `comm`. `scene` outlives this.
  SceneInput(const Communicator& comm, NamedScene& scene, bool dedicatedHost);
  /// Collective. Throws CollectiveError if drawing failed on a rank.
  CompositingInput make(ImageSize frame);

 private:
  const Communicator& comm_;
  NamedScene& scene_;
  node::Worker worker_;
};

/// `dedicatedHost`, here and below: rank 0 drew nothing.
/// Collective. Every rank drew a full frame of random, semi-transparent pixels.
CompositingInput denseInput(const Communicator& comm, ImageSize frame, bool dedicatedHost);

/// Collective. Every rank drew a disc of `fraction` of the frame's pixels, at a place of its own
/// and filled as in denseInput: any share of active pixels at will. The disc must fit into the
/// frame (pi/4 of a square at most).
CompositingInput discInput(const Communicator& comm, ImageSize frame, double fraction,
                           bool dedicatedHost);

}  // namespace burin::host::bench
