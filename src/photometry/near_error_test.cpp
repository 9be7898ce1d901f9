// SPDX-License-Identifier: Apache-2.0
// What a light field predicts of its own errors (ADR 39), where they are known.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sobol.h"
#include "photometry/near_error.h"

namespace sconce {
namespace {

constexpr double kSpacing = 0.01, kDistance = 0.25;
const Vec3 kUp(0, 0, 1);

/// One filter at the origin that sends E'(s, t) cd m2 towards each pixel of M, 0.8 m wide.
template <class F>
NearLamp one_filter(const F& intensity) {
  LightField f;
  f.columns = f.rows = 1;
  f.spacing = kSpacing, f.distance = kDistance;
  f.width = f.height = 400;
  f.pixel = 0.002, f.corner = glm::dvec2(-0.4);
  for (int t = 0; t < f.height; ++t)
    for (int s = 0; s < f.width; ++s) {
      const glm::dvec2 st = f.corner + f.pixel * (glm::dvec2(s, t) + 0.5);
      const double d2 = kDistance * kDistance, r2 = glm::dot(st, st) + d2;
      f.irradiance.push_back(static_cast<float>(intensity(st) * d2 / (r2 * r2)));
    }
  return NearLamp(std::move(f));
}

// Straight below the filter: cos4 falls from 1 to (1 + s2/4)^-2 at half of s = h |1/d - 1/z|. A receiver
// tilted by a sees its cosine change by tan a times the filter's reach over z. On M nothing is frozen.
TEST(NearError, GeometryIsTheSpreadOverTheFilter) {
  const NearLamp lamp = one_filter([](const glm::dvec2&) { return 1.0; });
  for (const double z : {0.02, 0.1, 1.0}) {
    const Vec3 x(0, 0, static_cast<float>(-z));
    const double s = kSpacing * std::abs(1 / kDistance - 1 / z), spread = 1 - std::pow(1 + s * s / 4, -2);
    EXPECT_NEAR(lamp.bound(x, kUp), spread, 1e-6) << z;
    const double tilt = 0.5;
    const Vec3 n(static_cast<float>(std::sin(tilt)), 0, static_cast<float>(std::cos(tilt)));
    EXPECT_NEAR(lamp.bound(x, n), spread + std::tan(tilt) * kSpacing / z, 1e-6) << z;
  }
  for (const float r : {0.0f, 0.05f, 0.15f}) EXPECT_NEAR(lamp.bound(Vec3(r, 0, -0.25f), kUp), 0, 1e-6) << r;
}

// 45 degrees aside: 2 s to first order, the paper's largest.
TEST(NearError, GeometryAsideIsTwiceTheStretch) {
  const NearLamp lamp = one_filter([](const glm::dvec2&) { return 1.0; });
  const double z = 0.15, s = kSpacing * std::abs(1 / kDistance - 1 / z);
  EXPECT_NEAR(lamp.bound(Vec3(0.15f, 0, -0.15f), kUp), 2 * s, 0.02 * s);
}

TEST(NearError, WhereGeometryIsAboveTheToleranceEquationFiveLights) {
  const NearLamp lamp = one_filter([](const glm::dvec2& st) { return 1 + 5 * st.x; });
  for (const float z : {0.02f, 0.1f, 1.0f}) {
    const Vec3 x(0.3f * z, 0, -z);
    const double bound = lamp.bound(x, kUp);
    ASSERT_NE(lamp.exact(x, kUp), lamp.approximate(x, kUp));
    EXPECT_EQ(lamp.illuminance(x, kUp, 0.99 * bound), lamp.exact(x, kUp)) << z;
    EXPECT_EQ(lamp.illuminance(x, kUp, 1.01 * bound), lamp.approximate(x, kUp)) << z;
  }
}

/// A field whose terms send what amount(m, n) says, evenly through M.
template <class F>
LightField even_terms(NearBasis basis, int columns, int rows, const F& amount) {
  LightField f;
  f.basis = basis;
  f.columns = columns, f.rows = rows;
  f.spacing = kSpacing, f.distance = kDistance;
  f.first = -0.5 * kSpacing * glm::dvec2(columns - 1, rows - 1);
  f.width = 3, f.height = 2;
  f.pixel = 2, f.corner = glm::dvec2(-3, -1);
  for (int n = 0; n < rows; ++n)
    for (int m = 0; m < columns; ++m)
      f.irradiance.insert(f.irradiance.end(), f.pixels(), static_cast<float>(amount(m, n)));
  return f;
}

// Flux stays. A spline twice as wide is (1, 3, 3, 1)/4 of narrow ones along an axis: measured by wide ones it
// is that one again.
TEST(NearError, WideFiltersMeasureWhatNarrowOnesMade) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const LightField field = even_terms(basis, 5, 4, [](int m, int n) { return 1 + m - 0.7 * n * m; }),
                     wide = widened(field);
    EXPECT_NEAR(flux(wide), flux(field), 1e-6 * std::abs(flux(field)));
    EXPECT_EQ(wide.spacing, 2 * kSpacing);
  }
  constexpr double kNarrow[] = {0, 1, 3, 3, 1, 0};
  const LightField wide = widened(
      even_terms(NearBasis::spline, 6, 6, [&](int m, int n) { return kNarrow[m] * kNarrow[n] / 16; }));
  int found = 0;
  for (int n = 0; n < wide.rows; ++n)
    for (int m = 0; m < wide.columns; ++m) {
      const bool middle = glm::length(wide.center(m, n)) < 1e-9;
      found += middle ? 1 : 0;
      // Shares of flux are a quarter of those of light: the filter is four times as large.
      EXPECT_NEAR(wide.image(static_cast<std::size_t>(n * wide.columns + m))[0], middle ? 4 : 0, 0.01) << m;
    }
  EXPECT_EQ(found, 1);
}

// Five spacings away an even lamp loses next to nothing in filters twice as wide; two spacings away these are
// coarse, and worse for stripes as narrow as they are.
TEST(NearError, IsLargeWherePatternsAreAsNarrowAsTheFilters) {
  const auto error = [](const LightField& field, float z) {
    const NearLamp lamp(field);
    return NearError(lamp).at(Vec3(0, 0, -z), kUp) / lamp.approximate(Vec3(0, 0, -z), kUp);
  };
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const LightField even = even_terms(basis, 24, 24, [](int, int) { return 1; }),
                     stripes = even_terms(basis, 24, 24, [](int m, int) { return m / 2 % 2 == 0 ? 2 : 0; });
    EXPECT_LT(error(even, 0.05f), 0.02) << name_of(basis);
    EXPECT_GT(error(stripes, 0.02f), 1.5 * error(even, 0.02f)) << name_of(basis);
  }
  const NearLamp above(even_terms(NearBasis::bell, 4, 4, [](int, int) { return 1; }));
  EXPECT_EQ(NearError(above).at(Vec3(0, 0, 0.1f), kUp), 0);
}

// Fields of the same lamp from other rays scatter by it, or by less, down to a quarter: what filters have in
// common and where pixels lie is not looked at.
TEST(NearError, NoiseIsTheScatterOfRays) {
  constexpr int kFields = 60;
  constexpr uint32_t kRays = 4000;
  constexpr float kDistances[] = {0.05f, 0.25f, 1};
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    double sum[3] = {}, squares[3] = {}, predicted[3] = {};
    for (uint32_t seed = 1; seed <= kFields; ++seed) {
      std::vector<SourceRay> rays;
      for (uint32_t i = 0; i < kRays; ++i) {
        const Vec2 u = sobol_pair(i, 0, seed);
        const Vec3 d = square_to_cosine(sobol_pair(i, 1, seed));
        if (sobol_pair(i, 2, seed).x < 0.5f)  // half of them, by chance, so that counts scatter
          rays.push_back({Vec3(0.1f * (u.x - 0.5f), 0.1f * (u.y - 0.5f), 0), Vec3(d.x, d.y, -d.z), 1e-3f});
      }
      LightFieldBuilder builder(make_light_field(basis, Vec2(-0.05f), Vec2(0.05f), 0.02, 0.25, 0.5, 21));
      builder.add(rays);
      const NearLamp lamp(std::move(builder).finish());
      EXPECT_NEAR(lamp.field().grain, 1e-3, 1e-8);
      for (int i = 0; i < 3; ++i) {
        const Vec3 x(0.003f, 0, -kDistances[i]);
        const double e = lamp.approximate(x, kUp);
        sum[i] += e, squares[i] += e * e, predicted[i] += lamp.noise(x, kUp) / kFields;
      }
    }
    for (int i = 0; i < 3; ++i) {
      const double scatter = std::sqrt((squares[i] - sum[i] * sum[i] / kFields) / (kFields - 1));
      std::printf("  %s, z %.2f: scatter %.3g, predicted %.3g, of %.3g lux\n", name_of(basis),
                  static_cast<double>(kDistances[i]), scatter, predicted[i], sum[i] / kFields);
      EXPECT_LT(scatter, 1.2 * predicted[i]);
      EXPECT_GT(scatter, predicted[i] / 4);
    }
  }
}

}  // namespace
}  // namespace sconce
