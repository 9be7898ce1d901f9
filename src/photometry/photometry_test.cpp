// SPDX-License-Identifier: Apache-2.0
// Tables with known integrals.
#include "photometry/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sobol.h"
#include "photometry/figures.h"

namespace sconce {
namespace {

constexpr double kPiD = std::numbers::pi;

/// I = 1000 cos(gamma) below the horizon at every `step` degrees.
Photometry lambert(double step) {
  Photometry p;
  p.azimuths = {0, 360};
  for (double g = 0; g <= 90 + 1e-9; g += step) p.polars.push_back(g);
  for (int plane = 0; plane < 2; ++plane)
    for (const double g : p.polars) p.candela.push_back(1000 * std::max(0.0, std::cos(g * kPiD / 180)));
  return p;
}

// methods.md 2.7: pi I0 x (1 - 2.5e-5, 1.6e-4, 6.4e-4, 2.5e-3).
TEST(Photometry, FluxOfALambertTable) {
  for (const auto& [step, missing] :
       {std::pair(1.0, 2.5e-5), std::pair(2.5, 1.6e-4), std::pair(5.0, 6.4e-4), std::pair(10.0, 2.5e-3)})
    EXPECT_NEAR(1 - flux(lambert(step)) / (1000 * kPiD), missing, 0.05 * missing) << step;
  EXPECT_EQ(downward_fraction(lambert(5)), 1);
}

// Against sums over directions, for a table that turns: every type integrates its own interpolation.
TEST(Photometry, FluxIsTheIntegralOfIntensity) {
  for (const auto type : {Photometry::Type::c, Photometry::Type::b, Photometry::Type::a}) {
    Photometry p;
    p.type = type;
    if (type == Photometry::Type::c)
      p.azimuths = {0, 70, 200, 360};
    else
      p.azimuths = {-90, -20, 10, 90};
    p.polars = {0, 30, 60, 110, 180};
    for (std::size_t i = 0; i < 20; ++i) p.candela.push_back(static_cast<double>(i * i % 7 + 1));
    std::copy(p.candela.begin(), p.candela.begin() + 5, p.candela.end() - 5);
    double sum = 0;
    const uint32_t n = 1 << 16;
    for (uint32_t i = 0; i < n; ++i) {
      const Vec2 u = sobol_pair(i, 0, 1);
      const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
      sum += intensity(p, {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z}) * 4 * kPiD / n;
    }
    EXPECT_NEAR(flux(p) / sum, 1, 2e-3) << static_cast<int>(type);
  }
}

TEST(Photometry, AnglesAndDirectionsAreInverse) {
  for (const auto type : {Photometry::Type::c, Photometry::Type::b, Photometry::Type::a})
    for (uint32_t i = 0; i < 256; ++i) {
      const Vec2 u = sobol_pair(i, 0, 2);
      const double azimuth = static_cast<double>(type == Photometry::Type::c ? 360 * u.x : 180 * u.x - 90);
      const double polar = 1 + 178 * static_cast<double>(u.y);
      const auto [a, p] = angles_of(type, direction_of(type, azimuth, polar));
      EXPECT_NEAR(a, azimuth, 1e-3);
      EXPECT_NEAR(p, polar, 1e-3);
    }
  EXPECT_NEAR(glm::distance(direction_of(Photometry::Type::c, 0, 90), Vec3(1, 0, 0)), 0, 1e-6) << "C0";
  EXPECT_NEAR(glm::distance(direction_of(Photometry::Type::c, 90, 90), Vec3(0, 1, 0)), 0, 1e-6) << "C90";
  EXPECT_NEAR(glm::distance(direction_of(Photometry::Type::c, 0, 0), Vec3(0, 0, -1)), 0, 1e-6) << "nadir";
}

// cos(gamma) falls to one half at 60 degrees, to a tenth at 84.3.
TEST(Photometry, BeamOfALambertTable) {
  const Photometry p = lambert(1);
  EXPECT_NEAR(beam_angle(p, 0, 0.5), 120, 0.3);
  EXPECT_NEAR(beam_angle(p, 90, 0.1), 168.5, 0.3);
  EXPECT_EQ(peak_of(p).candela, 1000);
  EXPECT_EQ(peak_of(p).polar, 0);
}

// In a square room of index k, height 1 below the lamps, a Lambertian ceiling lights the working plane by the
// form factor of two parallel squares of side 2 k (methods.md test 4): 0.1998 for the cube, k = 0.5.
TEST(Photometry, DirectRatiosAreFormFactors) {
  const auto ratios = direct_ratios(lambert(1));
  const auto facing = [](double x) {
    const double s = std::sqrt(1 + x * x);
    return 2 / (kPiD * x * x) *
           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) + 2 * x * s * std::atan(x / s) -
            2 * x * std::atan(x));
  };
  for (std::size_t i = 0; i < ratios.size(); ++i)
    EXPECT_NEAR(ratios[i], facing(2 * kRoomIndices[i]), 2e-3) << kRoomIndices[i];
}

TEST(Photometry, SymmetryIsFound) {
  EXPECT_EQ(symmetry_of(lambert(10)), Symmetry::axial);
  Photometry p = lambert(45);
  p.azimuths = {0, 90, 180, 270, 360};
  p.candela = {1, 1, 0, 2, 2, 0, 1, 1, 0, 2, 2, 0, 1, 1, 0};
  EXPECT_EQ(symmetry_of(p), Symmetry::quadrants);
  p.candela[6] = 3;
  EXPECT_EQ(symmetry_of(p), Symmetry::about_c0);
  p.candela[6] = 1, p.candela[3] = 3;
  EXPECT_EQ(symmetry_of(p), Symmetry::about_c90);
  p.candela[6] = 4;
  EXPECT_EQ(symmetry_of(p), Symmetry::none);
}

}  // namespace
}  // namespace sconce
