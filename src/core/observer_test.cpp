// SPDX-License-Identifier: Apache-2.0
#include "core/observer.h"

#include <gtest/gtest.h>

namespace sconce {
namespace {

TEST(Observer, LuminosityAndEqualEnergy) {
  EXPECT_EQ(observer(560)[1], 0.995);
  EXPECT_NEAR(observer(555)[1], 1, 0.006);  // between two values of the table
  EXPECT_EQ(observer(379)[1], 0);
  EXPECT_EQ(observer(771)[0], 0);
  Xyz sum{};
  for (int i = 380; i <= 770; ++i)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += observer(i)[c];
  for (const double v : sum) EXPECT_NEAR(v, 106.86, 0.15);  // nm, of all three; the table begins at 380
}

TEST(Observer, RecAndBack) {
  const Xyz d65 = xyz_of(Rgb(1));
  EXPECT_NEAR(d65[0], 0.95047, 1e-5);
  EXPECT_NEAR(d65[2], 1.08883, 1e-5);
  const Xyz xyz{0.3, 0.4, 0.1}, rgb = rec709_of(xyz);
  const Xyz back =
      xyz_of(Rgb(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], xyz[c], 1e-6);
  const Rgb red = color_of(observer(620));
  EXPECT_NEAR(luminance(red), 1, 1e-5f);
  EXPECT_LT(red.g, 0);
  EXPECT_EQ(color_of(Xyz{1, 0, 0}), Rgb(1));
}

}  // namespace
}  // namespace sconce
