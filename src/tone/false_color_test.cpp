// SPDX-License-Identifier: Apache-2.0
#include "tone/false_color.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sconce {
namespace {

TEST(FalseColor, ScalesAreEvenInStepsOrInRatios) {
  const FalseColor linear{.low = 0, .high = 500};
  EXPECT_FLOAT_EQ(linear.place(125), 0.25f);
  EXPECT_FLOAT_EQ(linear.place(-3), 0);
  EXPECT_FLOAT_EQ(linear.place(1e9f), 1);
  EXPECT_FLOAT_EQ(linear.place(std::numeric_limits<float>::quiet_NaN()), 0);
  const FalseColor decades{.low = 1, .high = 10000, .decades = true};
  EXPECT_FLOAT_EQ(decades.place(100), 0.5f);
  EXPECT_FLOAT_EQ(decades.place(0), 0);
}

TEST(FalseColor, TicksAreRound) {
  EXPECT_EQ(legend_ticks({.low = 0, .high = 500}), (std::vector<float>{0, 100, 200, 300, 400, 500}));
  EXPECT_EQ(legend_ticks({.low = 0, .high = 2}), (std::vector<float>{0, 0.5f, 1, 1.5f, 2}));
  EXPECT_EQ(legend_ticks({.low = 1, .high = 100, .decades = true}),
            (std::vector<float>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(tick_text(2000), "2,000");
  EXPECT_EQ(tick_text(1234567), "1,234,567");
  EXPECT_EQ(tick_text(0.05f), "0.05");
}

TEST(FalseColor, NeighbouringColoursDiffer) {
  for (int i = 0; i < 100; ++i) {
    const Rgb a = false_color(static_cast<float>(i) / 100), b = false_color(static_cast<float>(i + 1) / 100);
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 0.005f) << i;
  }
}

TEST(FalseColor, LinesLieWhereTicksAre) {
  Image ramp(100, 2, {"lux"});
  for (int x = 0; x < 100; ++x) *ramp.at(x, 0) = *ramp.at(x, 1) = static_cast<float>(x) + 0.5f;
  const Image8 lined = false_color(ramp, {.low = 0, .high = 100, .lines = true}),
               plain = false_color(ramp, {.low = 0, .high = 100});
  for (int x = 0; x < 99; ++x)
    EXPECT_EQ(
        lined.data[static_cast<std::size_t>(3 * x) + 2] != plain.data[static_cast<std::size_t>(3 * x) + 2],
        x % 20 == 19)
        << x;
}

TEST(FalseColor, BadScalesSaySo) {
  EXPECT_THROW((FalseColor{.low = 5, .high = 5}.check()), UsageError);
  EXPECT_THROW((FalseColor{.low = 0, .high = 5, .decades = true}.check()), UsageError);
}

}  // namespace
}  // namespace sconce
