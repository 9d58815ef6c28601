#pragma once

#include <memory>

#include "brick_renderer.hpp"
#include "burin/node/technique.hpp"
#include "program_uniforms.hpp"
#include "projector.hpp"

namespace burin::node {

/// What draws one of a scene's layerGroups(): media and surfaces by a technique, projections by
/// rays. Its OffscreenContext must be current.
class GroupRenderer {
 public:
  struct Options {
    DrawOptions draw;
    Technique technique = Technique::kRaycast;
    Precision precision = Precision::kFloat;
  };

  GroupRenderer(const Scene& group, const LabelMasks& masks, const ProgramVolume& volume,
                const Options& options)
      : volume_{volume}, options_{options} {
    setScene(group, masks);
  }

  /// Draws that group from now on, which may be of the other kind. If it throws, the one before
  /// stays. `masks`: those of the bricks.
  void setScene(const Scene& group, const LabelMasks& masks);
  std::size_t tableBytes() const { return media_ ? media_->tableBytes() : 0; }

  /// The one there is; the other kind is an error.
  BrickRenderer& media() const;
  Projector& projector() const;

 private:
  ProgramVolume volume_;
  Options options_;
  std::unique_ptr<BrickRenderer> media_;
  std::unique_ptr<Projector> projector_;
};

}  // namespace burin::node
