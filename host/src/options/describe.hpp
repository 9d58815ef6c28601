#pragma once

#include <functional>

#include "burin/host/command_line.hpp"
#include "options/option_list.hpp"

namespace burin::host {

/// Makes a command's struct of the options that were read; `ranks`: how many take part. Throws
/// Error{kUsage} for what only shows when all of them are known.
using Finish = std::function<Command(int ranks)>;

/// One command each: lists its options and the text below them.
Finish describeRender(OptionList& list);
Finish describeInfo(OptionList& list);
Finish describeMakeVolume(OptionList& list);
Finish describeStyles(OptionList& list);
Finish describeGallery(OptionList& list);
Finish describeColormap(OptionList& list);
Finish describeBenchCompositing(OptionList& list);
Finish describeBenchAccuracy(OptionList& list);
Finish describeBenchMaxError(OptionList& list);
Finish describeBenchSkip(OptionList& list);
Finish describeBenchScaling(OptionList& list);
Finish describeBenchRates(OptionList& list);

}  // namespace burin::host
