#pragma once

#include <string>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/host/picture.hpp"
#include "burin/host/text.hpp"

namespace burin::host {

/// How a sheet is divided.
struct SheetLayout {
  ImageSize panel;
  int columns = 1;
  int fontSize = 0;
  int labelLines = 1;
  int lineHeight = 0;
  int labelHeight = 0;  ///< of all lines
  ImageSize size;       ///< of all of it
};

/// Room for `count` panels with labels of so many lines. Throws Error{kUsage} if the sheet would be
/// larger than a picture may be, or if there is no font.
SheetLayout layOutSheet(ImageSize panel, int count, int columns, int labelLines = 1);

/// Pictures of one size in rows from top left, each with lines of text below. 3 channels.
class ContactSheet {
 public:
  explicit ContactSheet(const SheetLayout& layout);

  /// Panel `index` gets that picture (3 channels, of the panel's size) and that label, broken into
  /// lines between words; what is longer than a line or than all of them is cut off.
  void place(int index, const DisplayPicture& picture, const std::string& label);

  const DisplayPicture& picture() const { return sheet_; }

 private:
  std::vector<InkMask> lines(const std::string& label) const;

  SheetLayout layout_;
  DisplayPicture sheet_;
};

/// As many columns as make a sheet of `count` panels about square.
int squareColumns(int count);

}  // namespace burin::host
