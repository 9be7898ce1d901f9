// SPDX-License-Identifier: Apache-2.0
#include "image/draw.h"

#include <algorithm>
#include <cctype>

#include "image/pixel_font.h"

namespace sconce {

void fill(Image8& picture, int x, int y, int width, int height, const Color8& color) {
  for (int j = std::max(0, y); j < std::min(picture.height, y + height); ++j)
    for (int i = std::max(0, x); i < std::min(picture.width, x + width); ++i)
      std::copy(color.begin(), color.end(),
                picture.data.begin() + (std::ptrdiff_t{j} * picture.width + i) * picture.channels);
}

void draw_text(Image8& picture, int x, int y, std::string_view text, int dot, const Color8& color) {
  for (const char c : text) {
    const std::size_t glyph =
        kGlyphNames.find(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    if (glyph != std::string_view::npos)
      for (int row = 0; row < kGlyphHeight; ++row)
        for (int column = 0; column < kGlyphWidth; ++column)
          if (kGlyphs[glyph][static_cast<std::size_t>(row)] >> (kGlyphWidth - 1 - column) & 1)
            fill(picture, x + column * dot, y + row * dot, dot, dot, color);
    x += (kGlyphWidth + 1) * dot;
  }
}

int text_width(std::string_view text, int dot) {
  return static_cast<int>(text.size()) * (kGlyphWidth + 1) * dot;
}
int text_height(int dot) {
  return kGlyphHeight * dot;
}

}  // namespace sconce
