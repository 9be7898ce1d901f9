// SPDX-License-Identifier: Apache-2.0
// UGR tables against those that DIALux, Relux and CIE 190 give for the same files.
#include "photometry/ugr.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/test_data.h"
#include "photometry/position_index.h"
#include "photometry/test_ugr.h"

namespace sconce {
namespace {

TEST(Ugr, ProjectedAreas) {
  const Opening box{Opening::Shape::box, 2, Vec3(2, 3, 0.5f)},
      drum{Opening::Shape::cylinder, 2, Vec3(2, 2, 0.5f)};
  const Opening ball{Opening::Shape::ellipsoid, 2, Vec3(2)};
  const Vec3 side(0, 1, 0), up(0, 0, 1), slant = glm::normalize(Vec3(1, 2, 2));
  EXPECT_NEAR(projected_area(box, up), 6, 1e-6);
  EXPECT_NEAR(projected_area(box, side), 1, 1e-6);
  EXPECT_NEAR(projected_area(box, slant), (1.5 + 2 + 12) / 3, 1e-6);
  EXPECT_NEAR(projected_area(drum, up), M_PI, 1e-6);
  EXPECT_NEAR(projected_area(drum, side), 1, 1e-6);
  EXPECT_NEAR(projected_area(ball, slant), M_PI, 1e-6);
}

// Levin's formula is another man's fit to Guth's data: a slip of a digit in the table would leave its band
// (4.5 % off in the mean, 11 % where the print itself slips).
TEST(Ugr, PositionIndexIsGuths) {
  EXPECT_EQ(position_index(0, 0), 1.0);
  EXPECT_NEAR(*position_index(1.05, 0.55), (3.91 + 4.4 + 4.2 + 4.7) / 4, 1e-12);
  EXPECT_FALSE(position_index(0, 1.75));
  EXPECT_FALSE(position_index(3.01, 0.5));
  EXPECT_EQ(position_index(3, 1.9), 16.0);
  std::size_t knots = 0;
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 19; ++j) {
      const double lateral = i / 10.0, height = j / 10.0;
      const auto p = position_index(lateral, height);
      if (!p) continue;
      ++knots;
      const double alpha = height > 0 ? std::atan(lateral / height) * 180 / M_PI : 90,
                   beta = std::acos(1 / std::sqrt(1 + lateral * lateral + height * height)) * 180 / M_PI;
      const double levin = std::exp((35.2 - 0.31889 * alpha - 1.22 * std::exp(-2 * alpha / 9)) * 1e-3 * beta +
                                    (21 + 0.26667 * alpha - 0.002963 * alpha * alpha) * 1e-5 * beta * beta);
      EXPECT_NEAR(*p / levin, 1, i == 27 && j == 6 ? 0.12 : 0.1) << lateral << ", " << height;
    }
  EXPECT_EQ(knots, 31u * 20 - 13);
}

// The references differ by up to 0.8 among themselves and come rounded to 0.1. Sample 06 shines 79 % upwards:
// its ratings lie below 10, where Relux prints "<10.0" and DIALux counts lamps that CIE 117 leaves out
// (height / distance above 1.9); there we agree with Relux. What is further off than 0.1 is sample 05, whose
// coarse table integrates to 2.5 % more than it states: 8 log10(1.025) = 0.09.
TEST(Ugr, TablesOfOtherPrograms) {
  const std::filesystem::path folder = test_data() / "photometry/ldt/eulumdat-ugr";
  SCONCE_NEEDS_DATA(folder);
  std::size_t cells = 0, near = 0;
  for (const char* sample : kUgrSamples) {
    const UgrComparison c = compare_ugr(folder, sample);
    EXPECT_GE(c.references, 2u);
    EXPECT_LT(c.outside, 0.301) << sample;
    cells += c.cells, near += c.near;
  }
  EXPECT_EQ(cells, 950u);
  EXPECT_GE(static_cast<double>(near), 0.95 * static_cast<double>(cells)) << near;
}

}  // namespace
}  // namespace sconce
