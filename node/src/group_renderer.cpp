#include "group_renderer.hpp"

#include "burin/common/error.hpp"
#include "raycaster.hpp"
#include "slicer.hpp"

namespace burin::node {

void GroupRenderer::setScene(const Scene& group, const LabelMasks& masks) {
  if (isProjection(group.layers.front().mode)) {
    if (projector_)
      projector_->setScene(group);
    else
      projector_ = std::make_unique<Projector>(group, volume_, options_.draw);
    media_.reset();
    return;
  }
  if (media_)
    media_->setScene(group, masks);
  else if (options_.technique == Technique::kSlices)
    media_ = std::make_unique<Slicer>(group, masks, volume_, options_.draw, options_.precision);
  else
    media_ = std::make_unique<Raycaster>(group, masks, volume_, options_.draw);
  projector_.reset();
}

BrickRenderer& GroupRenderer::media() const {
  BURIN_CHECK(media_ != nullptr);
  return *media_;
}

Projector& GroupRenderer::projector() const {
  BURIN_CHECK(projector_ != nullptr);
  return *projector_;
}

}  // namespace burin::node
