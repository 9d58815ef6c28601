#pragma once

#include "burin/common/communicator.hpp"
#include "burin/host/command_line.hpp"

namespace burin::host {

/// One command each. Collective; return the exit code, throw SharedError or CollectiveError on all
/// ranks alike. Only rank 0 prints.
int runRender(const Communicator& comm, const RenderOptions& options);
int runInfo(const Communicator& comm, const InfoOptions& options);
int runMakeVolume(const Communicator& comm, const MakeVolumeOptions& options);
int runStyles(const Communicator& comm);
int runBenchCompositing(const Communicator& comm, const BenchCompositingOptions& options);
int runBenchSkip(const Communicator& comm, const BenchSkipOptions& options);
int runBenchAccuracy(const Communicator& comm, const BenchAccuracyOptions& options);
int runBenchMaxError(const Communicator& comm, const BenchMaxErrorOptions& options);
int runBenchScaling(const Communicator& comm, const BenchScalingOptions& options);

}  // namespace burin::host
