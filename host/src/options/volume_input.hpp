#pragma once

#include <string>

#include "burin/host/command_line.hpp"
#include "options/option_list.hpp"

namespace burin::host {

/// --dims, --type, --endian and --spacing of a bare raw file, --component and --series of any
/// other, as they were typed.
struct RawText {
  std::string dims, type, endian, spacing, series;
  int component = -1;  ///< none
};

void addRawOptions(OptionList& list, RawText& text);

/// Throws Error{kUsage} naming the option that makes no sense.
RawLayout rawLayout(const RawText& text);

/// The options of a label volume, as they were typed.
struct LabelText {
  std::string file, names;
  int component = -1;  ///< none
};

void addLabelOptions(OptionList& list, LabelText& text);
/// --label-names alone.
void addLabelNames(OptionList& list, std::string& names);
LabelOptions labelOptions(const LabelText& text);

/// INPUT, a scene or a volume.
void addInput(OptionList& list, std::string& input);
/// --volume, the volume drawn with a scene.
void addVolume(OptionList& list, std::string& volume);
/// Throws Error{kUsage} if `input` is a volume and `volume` is given, too.
void checkVolumeChoice(const std::string& input, const std::string& volume);

}  // namespace burin::host
