#include "text_renderer.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

namespace burin::host {

extern "C" void burinRenderText(const TextToRender& text, RenderedText& rendered) {
  namespace Algorithm = OIIO::ImageBufAlgo;
  rendered.hasFont = Algorithm::text_size("x", text.fontSize, text.font).defined();
  const OIIO::ROI size = Algorithm::text_size(text.text, text.fontSize, text.font);
  if (!size.defined() || size.xend <= size.xbegin) return;  // no font, or blanks alone
  // A pixel more on each side: letters may reach a little beyond where they are said to end.
  rendered.width = size.width() + 2;
  rendered.coverage.resize(static_cast<std::size_t>(rendered.width) *
                           static_cast<std::size_t>(text.height));
  const OIIO::ImageSpec spec{rendered.width, text.height, 1, OIIO::TypeDesc::UINT8};
  OIIO::ImageBuf image{spec, rendered.coverage.data()};
  if (!Algorithm::render_text(image, 1 - size.xbegin, text.ascent, text.text, text.fontSize,
                              text.font))
    rendered.error = image.geterror();
}

static_assert(std::is_same_v<decltype(burinRenderText), RenderText>);

}  // namespace burin::host
