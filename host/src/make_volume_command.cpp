#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/host/progress.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/procedural.hpp"
#include "burin/node/volume_writer.hpp"

namespace burin::host {

namespace {

void makeVolume(const MakeVolumeOptions& options) {
  const auto type = node::voxelTypeFromName(options.type);
  BURIN_CHECK(type.has_value());  // the command line knows the same names
  const auto source = node::makeProcedural(options.kind, options.dims, *type, options.spacing);
  Progress progress{true};
  node::WriteOptions writing;
  writing.progress = [&](double share) {
    if (const int signal = interruptSignal(); signal != 0)
      fail(ExitCode::kRank, "{}: not written, stopped by signal {}", options.output.string(),
           signal);
    progress.show(fmt::format("writing {:.0f} %", 100 * share));
  };
  node::writeVolume(*source, options.output, writing);
  const std::string name = options.output.filename().string();
  if (options.spacing != glm::dvec3{1} && (name.ends_with(".raw") || name.ends_with(".raw.gz")))
    note("{}: bare voxels; reading them takes --spacing {},{},{}", options.output.string(),
         options.spacing.x, options.spacing.y, options.spacing.z);
}

}  // namespace

int runCommand(const Communicator& comm, const MakeVolumeOptions& options) {
  const InterruptWatch watch;
  onRoot(comm, [&] { makeVolume(options); });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
