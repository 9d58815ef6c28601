#pragma once

namespace burin::host::bench {

/// Whether the finished pixels go to the display rank or stay where they were composited.
enum class Collect : bool { kNo, kYes };

}  // namespace burin::host::bench
