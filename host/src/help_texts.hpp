#pragma once

#include <string>

namespace burin::host {

/// What stands below the option lists of --help.
std::string programFooter();
std::string renderFooter();
std::string makeVolumeFooter();
std::string benchCompositingFooter();
std::string benchSkipFooter();
std::string benchAccuracyFooter();
std::string benchMaxErrorFooter();
std::string benchScalingFooter();

}  // namespace burin::host
