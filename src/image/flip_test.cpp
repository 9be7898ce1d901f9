// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace sconce {
namespace {

Image constant(const Rgb& c, int width = 24, int height = 16) {
  Image image = Image::rgb(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, c);
  return image;
}

Image waves(float phase, bool step) {
  Image image = Image::rgb(96, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      const float blue = !step ? (fx + fy) / 160 : x < 48 ? 1.0f : 0.0f;
      image.set_rgb(x, y,
                    {0.5f + 0.5f * std::sin(0.3f * fx + phase), 0.5f + 0.5f * std::sin(0.2f * fy), blue});
    }
  return image;
}

TEST(Flip, EqualIsZero) {
  const Image a = waves(0, false);
  EXPECT_EQ(flip(a, a).mean, 0);
}

// Plain colours have no features and pass the filters whole; what is left is the colour pipeline. CIELAB
// (D65) of the sRGB primaries as tables give it: green (87.735, -86.183, 83.179), blue (32.297, 79.188,
// -107.860); with chroma times L / 100 HyAB(green, blue) = 203.30, to the power of 0.7 41.277, the largest
// there is.
TEST(Flip, PlainColours) {
  EXPECT_NEAR(flip(constant({0, 1, 0}), constant({0, 0, 1})).mean, 1, 1e-5);
  // Black to white: HyAB = 100, 100^0.7 = 25.119 lies above the knee 0.4 * 41.277 = 16.511.
  const double above = 0.95 + (25.1189 - 16.5108) / (41.277 - 16.5108) * 0.05;
  EXPECT_NEAR(flip(constant(Rgb(0)), constant(Rgb(1))).mean, above, 1e-4);
  // L = 50 is 18.4187 % of white's light, L = 60 28.1233 %; 10^0.7 = 5.0119 lies below the knee.
  EXPECT_NEAR(flip(constant(Rgb(0.184187f)), constant(Rgb(0.281233f))).mean, 0.95 * 5.0119 / 16.5108, 1e-4);
}

// The authors' program (github.com/NVlabs/flip, version 1.6, single precision) gives for these two: mean
// 0.85055, and 0.96664, 0.33905, 0.95590 at three pixels.
TEST(Flip, AsTheAuthorsProgram) {
  const Flip f = flip(waves(0, false), waves(0.4f, true));
  EXPECT_NEAR(f.mean, 0.85055, 5e-5);
  EXPECT_NEAR(*f.map.at(0, 0), 0.96664, 5e-5);
  EXPECT_NEAR(*f.map.at(48, 32), 0.33905, 5e-5);
  EXPECT_NEAR(*f.map.at(20, 10), 0.95590, 5e-5);
}

TEST(Flip, EqualInBothDirections) {
  const Image a = waves(0, false), b = waves(0.4f, true);
  EXPECT_EQ(flip(a, b).map.data, flip(b, a).map.data);
}

TEST(Flip, DotsAreSeenFromNearby) {
  const Image grey = constant(Rgb(0.2f), 48, 48);
  Image dotted = grey;
  dotted.set_rgb(24, 24, Rgb(0.6f));
  const double near = flip(dotted, grey, 20).mean, far = flip(dotted, grey, 200).mean;
  EXPECT_GT(*flip(dotted, grey, 20).map.at(24, 24), 3 * *flip(dotted, grey, 200).map.at(24, 24));
  EXPECT_GT(near, 0);
  EXPECT_GT(far, 0);
}

TEST(Flip, OnlyOfPicturesForADisplay) {
  const Image good = constant(Rgb(0.5f));
  EXPECT_TRUE(is_display_light(good));
  for (const float bad : {-0.01f, 1.01f, std::numeric_limits<float>::quiet_NaN()}) {
    Image image = good;
    image.at(3, 2)[1] = bad;
    EXPECT_FALSE(is_display_light(image));
    EXPECT_THROW(flip(image, good), Error);
    EXPECT_THROW(flip(good, image), Error);
  }
  EXPECT_THROW(flip(good, constant(Rgb(0.5f), 16, 16)), Error);
  EXPECT_FALSE(is_display_light(Image(4, 4, {"Y"})));
}

}  // namespace
}  // namespace sconce
