// SPDX-License-Identifier: Apache-2.0
// methods.md tests 15 and 18, and the figures of section 2.6.
#include "photometry/near_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace sconce {
namespace {

/// Integral of a piecewise polynomial on half-integer knots, by three Gauss points a piece: exact up to
/// degree 5.
double integral(const std::function<double(double)>& f) {
  const double node = std::sqrt(0.6);
  double sum = 0;
  for (int i = -12; i < 12; ++i) {
    const double mid = 0.5 * i + 0.25;
    sum += 0.25 * (5.0 / 9 * (f(mid - 0.25 * node) + f(mid + 0.25 * node)) + 8.0 / 9 * f(mid));
  }
  return sum;
}

TEST(NearBasis, BellsFigures) {
  EXPECT_NEAR(integral(bell), 1, 1e-14);
  EXPECT_NEAR(integral([](double x) { return bell(x) * bell(x); }), 23.0 / 30, 1e-14);
  EXPECT_NEAR(integral([](double x) { return bell(x) * bell(x - 1); }), 7.0 / 60, 1e-14);
  for (double x = 0; x < 1; x += 0.01) EXPECT_NEAR(bell(x) + bell(x - 1), 1, 1e-14);
}

TEST(NearBasis, DualsAreDual) {
  for (double (*dual)(double) : {bell_dual, bell_dual_least}) {
    for (int k = -4; k <= 4; ++k)
      EXPECT_NEAR(integral([&](double x) { return dual(x) * bell(x - k); }), k == 0 ? 1 : 0, 1e-12) << k;
    EXPECT_NEAR(integral(dual), 1, 1e-12);
    for (double x = 0.005; x < 1; x += 0.01)  // not at the knots, where one of them jumps
      EXPECT_NEAR(dual(x - 2) + dual(x - 1) + dual(x) + dual(x + 1), 1, 1e-12) << x;
    EXPECT_EQ(dual(2), 0);
  }
  EXPECT_NEAR(bell_dual(0), 1.4375, 1e-12);
  EXPECT_NEAR(bell_dual(0.5), 0.49159, 1e-5);
  EXPECT_NEAR(bell_dual(1), -0.21875, 1e-12);
  EXPECT_NEAR(bell_dual(1.5), 0.00841, 1e-5);
  EXPECT_NEAR(bell_dual_least(0), 1.37092, 1e-5);
  EXPECT_NEAR(bell_dual_least(0.5), 0.57609, 1e-5);
  EXPECT_NEAR(bell_dual_least(1), -0.21875, 1e-12);
  EXPECT_NEAR(bell_dual_least(1.5), -0.07609, 1e-5);
  EXPECT_NEAR(bell_dual_least(1.9999999), 0.06658, 1e-4);
  EXPECT_NEAR(integral([](double x) { return bell_dual(x) * bell_dual(x); }), 1.40113, 1e-5);
  EXPECT_NEAR(integral([](double x) { return bell_dual_least(x) * bell_dual_least(x); }), 1009.0 / 736,
              1e-12);
  // C1 at every knot.
  for (const double knot : {0.5, 1.0, 1.5, 2.0}) {
    const double e = 1e-6;
    EXPECT_NEAR(bell_dual(knot - e), bell_dual(knot + e), 1e-5);
    EXPECT_NEAR((bell_dual(knot) - bell_dual(knot - e)) / e, (bell_dual(knot + e) - bell_dual(knot)) / e,
                1e-4);
  }
}

TEST(NearBasis, SplineAndItsDual) {
  EXPECT_NEAR(integral(spline), 1, 1e-14);
  EXPECT_NEAR(integral([](double x) { return spline(x) * spline(x); }), 66.0 / 120, 1e-14);
  EXPECT_NEAR(integral([](double x) { return spline(x) * spline(x - 1); }), 26.0 / 120, 1e-14);
  EXPECT_NEAR(integral([](double x) { return spline(x) * spline(x - 2); }), 1.0 / 120, 1e-14);
  // The dual's weights of an impulse; and it inverts the Gram matrix on joined ends.
  std::vector<double> v(24);
  v[12] = 1;
  spline_dual(v.data(), v.size(), 1);
  const double expected[] = {2.8422, -1.3217, 0.5733, -0.2470, 0.1064};
  double sum = 0;
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(v[static_cast<std::size_t>(12 + k)], expected[k], 1e-4) << k;
    EXPECT_NEAR(v[static_cast<std::size_t>(12 - k)], expected[k], 1e-4) << k;
  }
  for (const double x : v) sum += x;
  EXPECT_NEAR(sum, 1, 1e-13) << "sums are kept";
  for (std::size_t i = 0; i < 24; ++i) {
    const auto at = [&](std::size_t k) { return v[(i + k) % 24]; };
    const double gram = (66 * at(0) + 26 * (at(1) + at(23)) + at(2) + at(22)) / 120;
    EXPECT_NEAR(gram, i == 12 ? 1 : 0, 1e-12) << i;
  }
  std::vector<double> few = {1, 2, 4};
  spline_dual(few.data(), 3, 1);
  EXPECT_NEAR(few[0] + few[1] + few[2], 7, 1e-12);
}

// 2%, 8%, 20% at most, at 45 degrees; 8.0016% for s = 0.04.
TEST(NearBasis, GeometricSpread) {
  EXPECT_NEAR(geometric_spread(1, 0.04), 0.080016, 1e-6);
  for (const double s : {0.01, 0.04, 0.1})
    for (const double theta : {0.2, 0.5, M_PI / 4, 1.2})
      EXPECT_NEAR(geometric_spread(std::tan(theta), s), 2 * s * std::sin(2 * theta),
                  5 * s * s * s + 1e-3 * s);
  EXPECT_NEAR(geometric_spread(0, 0.1), 1 - 1 / std::pow(1 + 0.0025, 2), 1e-12)
      << "on the axis: of second order";
}

// Below the quantile lies the share: integral by the midpoint rule.
TEST(NearBasis, QuantilesAreThoseOfTheBasis) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const int steps = 40000;
    for (const double u : {0.001, 0.08, 0.3, 0.5, 0.77, 0.99}) {
      const double low = -basis_reach(basis), width = (basis_quantile(basis, u) - low) / steps;
      double share = 0;
      for (int i = 0; i < steps; ++i) share += basis_at(basis, low + (i + 0.5) * width) * width;
      EXPECT_NEAR(share, u, 1e-7) << u;
    }
    EXPECT_EQ(basis_named(name_of(basis)), basis);
  }
  EXPECT_FALSE(basis_named("box"));
}

}  // namespace
}  // namespace sconce
