// SPDX-License-Identifier: Apache-2.0
#include "mix/fit.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"

namespace sconce {
namespace {

/// sum_g row[g] * gain[g]
double mixed(const std::vector<double>& row, const std::vector<double>& gains) {
  double sum = 0;
  for (std::size_t g = 0; g < row.size(); ++g) sum += row[g] * gains[g];
  return sum;
}

TEST(Fit, OneWishOfOneGroup) {
  Wishes wishes(1);
  wishes.add(std::vector{200.0}, 300);
  const Fit found = fit(wishes);
  EXPECT_NEAR(found.gains[0], 1.5, 1e-12);
  EXPECT_NEAR(found.residual, 0, 1e-7);
}

// The unconstrained answer of x + y = 1, x - y = 3 is (2, -1); with y >= 0 the best is x = 2, off by 1 twice.
TEST(Fit, NoGainIsNegative) {
  Wishes wishes(2);
  wishes.add(std::vector{1.0, 1.0}, 1);
  wishes.add(std::vector{1.0, -1.0}, 3);
  const Fit found = fit(wishes);
  EXPECT_NEAR(found.gains[0], 2, 1e-12);
  EXPECT_EQ(found.gains[1], 0);
  EXPECT_NEAR(found.residual, std::sqrt(2.0 / 10), 1e-9);
}

TEST(Fit, RecoversTwentyFourGains) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(0, 1);
  std::vector<double> gains(24);
  for (std::size_t g = 0; g < 24; ++g) gains[g] = g % 5 == 0 ? 0 : 3 * at(random);
  Wishes wishes(24);
  for (int pixel = 0; pixel < 4000; ++pixel) {
    std::vector<double> row(24);
    for (double& v : row) v = std::pow(at(random), 4);
    wishes.add(row, mixed(row, gains));
  }
  const Fit found = fit(wishes);
  for (std::size_t g = 0; g < 24; ++g) EXPECT_NEAR(found.gains[g], gains[g], 1e-6) << g;
  EXPECT_LT(found.residual, 1e-6);
}

// Two lamps do the same; the one that takes half the power is to do it.
TEST(Fit, ThriftTakesTheCheaperLamp) {
  Wishes wishes(2);
  wishes.add(std::vector{100.0, 100.0}, 300);
  const Fit found = fit(wishes, std::vector{2000.0, 1000.0}, 1e-4);
  EXPECT_NEAR(found.gains[0], 0, 1e-6);
  EXPECT_NEAR(found.gains[1], 3, 1e-3);
}

// KKT: no held gain would help, every free one is at its best.
TEST(Fit, IsOptimal) {
  std::mt19937 random(5);
  std::normal_distribution<double> at;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::vector<double>> rows;
    std::vector<double> targets;
    Wishes wishes(8);
    for (int i = 0; i < 12; ++i) {
      rows.emplace_back();
      for (int g = 0; g < 8; ++g) rows.back().push_back(at(random));
      targets.push_back(at(random));
      wishes.add(rows.back(), targets.back());
    }
    const Fit found = fit(wishes);
    for (std::size_t g = 0; g < 8; ++g) {
      double gradient = 0;
      for (std::size_t i = 0; i < rows.size(); ++i)
        gradient += rows[i][g] * (targets[i] - mixed(rows[i], found.gains));
      EXPECT_LE(gradient, 1e-8);
      if (found.gains[g] > 0) {
        EXPECT_NEAR(gradient, 0, 1e-8);
      }
    }
  }
}

TEST(Fit, NothingWishedIsNothingDone) {
  EXPECT_EQ(fit(Wishes(3)).gains, std::vector<double>(3, 0));
  Wishes dark(2);
  dark.add(std::vector{0.0, 0.0}, 300);
  EXPECT_EQ(fit(dark).gains, std::vector<double>(2, 0));
  EXPECT_NEAR(fit(dark).residual, 1, 1e-12);
  EXPECT_THROW(dark.add(std::vector{1.0}, 1), Error);
}

}  // namespace
}  // namespace sconce
