// SPDX-License-Identifier: Apache-2.0
#include "core/kelvin.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace sconce {
namespace {

TEST(Kelvin, WhiteIsWhite) {
  const Rgb white = kelvin_color(6504);
  EXPECT_NEAR(white.r, 1, 1e-6);
  EXPECT_NEAR(white.g, 1, 1e-6);
  EXPECT_NEAR(white.b, 1, 1e-6);
}

// From published chromaticities of the Planckian locus, 2700 K: x 0.4599, y 0.4106; 6504 K: x 0.3135, y
// 0.3236.
TEST(Kelvin, Lamp2700) {
  const Rgb lamp = kelvin_color(2700);
  EXPECT_NEAR(lamp.r, 1.870, 0.004);
  EXPECT_NEAR(lamp.g, 0.8235, 0.002);
  EXPECT_NEAR(lamp.b, 0.1866, 0.002);
}

TEST(Kelvin, LuminanceOneAndMonotonousBlueToRed) {
  float before = 1e9f;
  for (int t = 1000; t <= 11000; t += 100) {
    const Rgb c = kelvin_color(t);
    EXPECT_NEAR(luminance(c), 1, 1e-5) << t;
    EXPECT_GE(c.b, 0) << t;
    EXPECT_LT(c.r / (c.r + c.b), before + 1e-6f) << t;
    before = c.r / (c.r + c.b);
  }
}

TEST(Kelvin, OutOfRangeIsAUsageError) {
  EXPECT_THROW(kelvin_color(999), UsageError);
  EXPECT_THROW(kelvin_color(11001), UsageError);
  EXPECT_THROW(kelvin_color(std::numeric_limits<double>::quiet_NaN()), UsageError);
}

}  // namespace
}  // namespace sconce
