#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace burin::host {

/// A line of text for the module burin_pictures (picture_encoder.hpp) to render.
struct TextToRender {
  std::string text;
  const char* font = nullptr;  ///< by name, looked for in the system's folders
  int fontSize = 0;            ///< pixels
  int ascent = 0;              ///< rows above the base line
  int height = 0;              ///< rows in all
};

struct RenderedText {
  int width = 0;
  std::vector<std::uint8_t> coverage;  ///< rows top to bottom, 255 wholly covered
  bool hasFont = false;
  std::string error;  ///< why there is no text, else ""
};

using RenderText = void(const TextToRender& text, RenderedText& rendered);
inline constexpr const char* kRenderText = "burinRenderText";

}  // namespace burin::host
