// SPDX-License-Identifier: Apache-2.0
#include "image/stroke_font.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sconce {
namespace {

struct Box {
  glm::dvec2 low{1e9}, high{-1e9};
};
Box box_of(std::string_view text, double size) {
  Box out;
  for (const auto& stroke : strokes_of(text, size))
    for (const glm::dvec2& p : stroke) out.low = glm::min(out.low, p), out.high = glm::max(out.high, p);
  return out;
}

TEST(StrokeFont, SizesAndBaseLine) {
  const Box capital = box_of("H", 100);
  EXPECT_NEAR(capital.low.y, -73, 1e-9);
  EXPECT_NEAR(capital.high.y, 0, 1e-9);
  EXPECT_NEAR(capital.high.x, stroke_text_width("H", 100), 1e-9);
  EXPECT_NEAR(box_of("x", 100).low.y, -73 * 8 / 12.0, 1e-9);  // small letters begin at a third
  EXPECT_GT(box_of("g", 100).high.y, 10);                     // below the base line
  EXPECT_NEAR(box_of("HH", 50).high.x, stroke_text_width("HH", 50), 1e-9);
}

TEST(StrokeFont, AllPrintableTextHasLinesWithinItsWidth) {
  for (const char* text : {"ABCDEFGHIJKLMNOPQRSTUVWXYZ", "abcdefghijklmnopqrstuvwxyz",
                           "0123456789.,:;-+/()[]%=_", "°²×·–'\"*<>!?|#&@"}) {
    const Box box = box_of(text, 20);
    EXPECT_GE(box.low.x, 0) << text;
    EXPECT_LE(box.high.x, stroke_text_width(text, 20) + 1e-9) << text;
  }
  EXPECT_EQ(strokes_of("Ü", 20), strokes_of("U", 20));  // without its dots
  EXPECT_TRUE(strokes_of(" \xe2\x82\xac\xff", 20).empty());
  EXPECT_GT(stroke_text_width(" ", 20), 0);
}

}  // namespace
}  // namespace sconce
