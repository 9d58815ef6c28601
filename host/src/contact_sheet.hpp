#pragma once

#include <string>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/host/picture.hpp"

namespace burin::host {

/// Pictures of one size in rows from top left, each with a line of text below. 3 channels.
class ContactSheet {
 public:
  /// Room for `count` panels. Throws Error{kUsage} if the sheet would be larger than a picture may
  /// be, or if there is no font.
  ContactSheet(ImageSize panel, int count, int columns);

  /// Panel `index` gets that picture (3 channels, of the panel's size) and that label, whose end is
  /// cut off if it is too long.
  void place(int index, const DisplayPicture& picture, const std::string& label);

  const DisplayPicture& picture() const { return sheet_; }

 private:
  ImageSize panel_;
  int columns_;
  int fontSize_;
  int labelHeight_;
  DisplayPicture sheet_;
};

/// As many columns as make a sheet of `count` panels about square.
int squareColumns(int count);

}  // namespace burin::host
