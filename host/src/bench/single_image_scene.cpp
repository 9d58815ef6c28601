#include "bench/single_image_scene.hpp"

#include "burin/common/error.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host::bench {

PreparedScene prepareSingleImage(const Communicator& comm, const RenderOptions& options) {
  PreparedScene prepared = prepareScene(comm, options);
  together(comm, "the scene", [&] {
    if (hasProjections(prepared.scene))
      fail(ExitCode::kUsage,
           "{}: this benchmark measures one image, not projections of their own: expected layers "
           "of mode \"dvr\" or \"iso\"",
           options.input);
  });
  return prepared;
}

}  // namespace burin::host::bench
