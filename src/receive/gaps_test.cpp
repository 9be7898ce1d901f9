// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "receive/test_scene.h"

namespace sconce {
namespace {

/// Two charts on a page of 16 x 16: texels [2,7) x [2,7) and [9,14) x [2,7), the second by one triangle pair
/// as well.
Atlas two_squares() {
  Atlas atlas;
  atlas.width = atlas.height = 16;
  atlas.pages = 1;
  for (uint32_t chart = 0; chart < 2; ++chart) {
    const float x = chart == 0 ? 2.0f : 9.0f;
    atlas.front.push_back({{Vec2(x, 2), Vec2(x + 5, 2), Vec2(x + 5, 7)}, 0, chart});
    atlas.front.push_back({{Vec2(x, 2), Vec2(x + 5, 7), Vec2(x, 7)}, 0, chart});
  }
  atlas.back.resize(4);
  return atlas;
}

TEST(Gaps, HolesAreFilledFromTheirOwnChartOnly) {
  const Atlas atlas = two_squares();
  Image image(16, 16, {"R", "G", "B", "A"});
  std::vector<uint8_t> valid(256, 0);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 14; ++x) {
      if (x == 7 || x == 8) continue;
      for (int c = 0; c < 4; ++c) image.at(x, y)[c] = x < 8 ? 1.0f : 5.0f;
      valid[static_cast<std::size_t>(16 * y + x)] = 1;
    }
  // A hole across the border column of the first chart, with nonsense in it.
  for (int y = 3; y < 6; ++y)
    for (int x = 4; x < 7; ++x) {
      valid[static_cast<std::size_t>(16 * y + x)] = 0;
      image.at(x, y)[0] = -7;
    }
  fill_gaps(atlas, 0, valid, image);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 4; ++c)
        EXPECT_FLOAT_EQ(image.at(x, y)[c], x < 8 ? 1.0f : 5.0f) << x << " " << y << " " << c;
}

TEST(Gaps, FillIsSmoothBetweenItsBorders) {
  const Atlas atlas = two_squares();
  Image image(16, 16, {"Y"});
  std::vector<uint8_t> valid(256, 0);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) {
      image.at(x, y)[0] = static_cast<float>(x);
      valid[static_cast<std::size_t>(16 * y + x)] = x == 2 || x == 6 ? 1 : 0;
    }
  fill_gaps(atlas, 0, valid, image);
  for (int x = 2; x < 7; ++x) EXPECT_NEAR(image.at(x, 4)[0], static_cast<float>(x), 0.1f);
  EXPECT_EQ(image.at(11, 4)[0], 0.0f);  // a chart without any value stays as it is
}

}  // namespace
}  // namespace sconce
