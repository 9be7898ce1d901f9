// SPDX-License-Identifier: Apache-2.0
// Rectangles and small text in pictures of bytes.
#pragma once

#include <array>
#include <string_view>

#include "image/image.h"

namespace sconce {

using Color8 = std::array<unsigned char, 3>;

/// What lies outside of the picture is left out. @pre at least three channels
void fill(Image8& picture, int x, int y, int width, int height, const Color8& color);

/// Letters (as capitals), figures and a few signs, `dot` pixels a dot; others are blank.
void draw_text(Image8& picture, int x, int y, std::string_view text, int dot, const Color8& color);
/// Pixels that a text takes.
int text_width(std::string_view text, int dot);
int text_height(int dot);

}  // namespace sconce
