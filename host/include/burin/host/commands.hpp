#pragma once

#include "burin/common/communicator.hpp"
#include "burin/host/command_line.hpp"

namespace burin::host {

/// The command that takes these options. Collective; returns the exit code, throws SharedError or
/// CollectiveError on all ranks alike. Only rank 0 prints.
int runCommand(const Communicator& comm, const RenderOptions& options);
int runCommand(const Communicator& comm, const InfoOptions& options);
int runCommand(const Communicator& comm, const MakeVolumeOptions& options);
int runCommand(const Communicator& comm, const StylesOptions& options);
int runCommand(const Communicator& comm, const GalleryOptions& options);
int runCommand(const Communicator& comm, const ColormapOptions& options);
int runCommand(const Communicator& comm, const BenchCompositingOptions& options);
int runCommand(const Communicator& comm, const BenchSkipOptions& options);
int runCommand(const Communicator& comm, const BenchAccuracyOptions& options);
int runCommand(const Communicator& comm, const BenchMaxErrorOptions& options);
int runCommand(const Communicator& comm, const BenchScalingOptions& options);
int runCommand(const Communicator& comm, const BenchRatesOptions& options);
int runCommand(const Communicator& comm, const Answer& answer);

}  // namespace burin::host
