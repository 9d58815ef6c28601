#pragma once

#include <optional>
#include <string>

#include "burin/common/colour.hpp"

namespace burin {

/// A bar whose length in the world is written beside it, as seen at the camera's target.
struct ScaleBar {
  std::optional<double>
      length;  ///< world units; unset: a round number, about a fifth of the picture
  std::optional<std::string> unit;  ///< unset: "mm" for anatomical volumes, else none
  friend bool operator==(const ScaleBar&, const ScaleBar&) = default;
};

/// Little pictures and words over the picture, each one if it is set. They are for people who look
/// at it: files of float pixels go without.
struct Annotations {
  std::optional<std::string> title;
  bool hasOrientation = false;  ///< the world's axes as arrows
  std::optional<ScaleBar> scaleBar;
  bool hasLegend = false;  ///< colour and opacity by value, of each layer
  std::optional<Colour>
      colour;        ///< of words and lines; unset: dark or light against the background
  int fontSize = 0;  ///< pixels; 0: by the size of the picture

  bool any() const { return title || hasOrientation || scaleBar || hasLegend; }
  friend bool operator==(const Annotations&, const Annotations&) = default;
};

}  // namespace burin
