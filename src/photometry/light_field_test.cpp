// SPDX-License-Identifier: Apache-2.0
// methods.md tests 12, 16, 17, 19, 20: near-field lamps with known light.
#include "photometry/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/sobol.h"
#include "core/test_data.h"
#include "photometry/light_field_file.h"
#include "photometry/near_error.h"

namespace sconce {
namespace {

constexpr double kPiD = M_PI;

/// Rays of a Lambertian square of side `side` and 1 lm in the plane z = 0, shining to -z.
std::vector<SourceRay> square(float side, uint32_t count) {
  std::vector<SourceRay> out;
  for (uint32_t i = 0; i < count; ++i) {
    const Vec2 u = sobol_pair(i, 0, 1);
    const Vec3 d = square_to_cosine(sobol_pair(i, 1, 1));
    out.push_back({Vec3(side * (u.x - 0.5f), side * (u.y - 0.5f), 0), Vec3(d.x, -d.y, -d.z),
                   1.0f / static_cast<float>(count)});
  }
  return out;
}

/// Lambertian square of luminance 1 and side 2a seen from its axis at distance z (methods.md test 10).
double on_axis(double half, double z) {
  const double a = half / z, s = std::sqrt(1 + a * a);
  return 4 * 0.5 * 2 * (a / s) * std::atan(a / s);
}

// The images keep the flux of the rays, whatever the basis.
TEST(LightField, FluxIsConserved) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    LightFieldBuilder builder(make_light_field(basis, Vec2(-0.05f), Vec2(0.05f), 0.02, 0.5, 1, 40));
    const auto rays = square(0.1f, 1 << 14);
    builder.add(rays);
    builder.add(
        std::vector<SourceRay>{{Vec3(0), Vec3(0, 0, 1), 0.25f}, {Vec3(1, 0, 0), Vec3(0, 0, -1), 0.5f}});
    const double kept = builder.kept(), lost = builder.lost();
    EXPECT_NEAR(kept + lost, 1.75, 1e-9);
    EXPECT_GE(lost, 0.75) << "upward and beside the grid";
    const LightField field = std::move(builder).finish();
    EXPECT_NEAR(flux(field), kept, 1e-6 * kept) << "images are floats";
    // Sum over terms = unfiltered irradiance of M, pixel by pixel.
    std::vector<double> plain(field.pixels()), sums(field.pixels());
    for (const SourceRay& ray : rays) {
      const glm::dvec3 p(ray.position), d(ray.direction);
      const glm::dvec2 where = (glm::dvec2(p) + glm::dvec2(d) * (0.5 / -d.z) - field.corner) / field.pixel;
      if (where.x < 0 || where.y < 0 || where.x >= 40 || where.y >= 40) continue;
      plain[static_cast<std::size_t>(where.y) * 40 + static_cast<std::size_t>(where.x)] +=
          static_cast<double>(ray.flux) / (field.pixel * field.pixel);
    }
    for (std::size_t term = 0; term < field.terms(); ++term)
      for (std::size_t i = 0; i < field.pixels(); ++i) sums[i] += static_cast<double>(field.image(term)[i]);
    for (std::size_t i = 0; i < field.pixels(); ++i) EXPECT_NEAR(sums[i], plain[i], 1e-5 * plain[i] + 1e-5);
  }
}

/// A field whose images are noise: its lamp lies in the span of the basis by construction.
LightField noise(NearBasis basis) {
  LightField field = make_light_field(basis, Vec2(-0.02f), Vec2(0.02f), 0.02, 0.3, 0.4, 12);
  for (std::size_t i = 0; i < field.irradiance.size(); ++i)
    field.irradiance[i] = sobol_pair(static_cast<uint32_t>(i), 0, 5).x - 0.2f;
  return field;
}

// Eq. 2 applied to eq. 5 gives back every E_mn: the projection is idempotent.
TEST(LightField, WhatTheBasisSpansComesBack) {
  const NearLamp lamp(noise(NearBasis::bell));
  const LightField& f = lamp.field();
  const glm::dvec2 st = f.corner + f.pixel * glm::dvec2(7.5, 4.5);
  const double node = std::sqrt(0.6);
  for (int n = 2; n < f.rows - 2; ++n)
    for (int m = 2; m < f.columns - 2; ++m) {
      double sum = 0;  // three Gauss points per half spacing and axis
      for (int j = -4; j < 4; ++j)
        for (int i = -4; i < 4; ++i)
          for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a) {
              const glm::dvec2 x(0.5 * i + 0.25 + 0.25 * a * node, 0.5 * j + 0.25 + 0.25 * b * node);
              const glm::dvec2 uv = f.center(m, n) + f.spacing * x;
              const double weight = (a == 0 ? 8.0 : 5.0) / 9 * (b == 0 ? 8.0 : 5.0) / 9 / 16;
              const double r2 = glm::dot(st - uv, st - uv) + f.distance * f.distance;
              const double g = f.distance * f.distance / (r2 * r2);
              sum += weight * f.spacing * f.spacing * g * bell_dual(x.x) * bell_dual(x.y) *
                     lamp.radiance(uv, st);
            }
      const std::size_t term = static_cast<std::size_t>(n * f.columns + m);
      const auto expected = static_cast<double>(f.image(term)[4 * 12 + 7]);
      EXPECT_NEAR(sum, expected, 1e-6);
    }
}

/// E_mn of a Lambertian square of luminance 1 and side 5 (in units of 1) through the C1 dual at spacing h, d
/// = 25: by quadrature, so that the errors of eq. 14 are not those of rays.
LightField lambertian(double h) {
  LightField field = make_light_field(NearBasis::bell, Vec2(-2.5f), Vec2(2.5f), h, 25, 30, 60);
  const double node = 0.5 / std::sqrt(3.0);
  const int per_side = static_cast<int>(std::lround(5 / h)) * 2;  // half spacings
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m) {
      const glm::dvec2 c = field.center(m, n);
      float* image = &field.irradiance[static_cast<std::size_t>(n * field.columns + m) * field.pixels()];
      std::vector<std::pair<glm::dvec2, double>> points;
      for (int j = 0; j < per_side; ++j)
        for (int i = 0; i < per_side; ++i)
          for (int k = 0; k < 4; ++k) {
            const glm::dvec2 uv =
                glm::dvec2(-2.5) +
                0.5 * h * (glm::dvec2(i, j) + 0.5 + node * glm::dvec2(k % 2 == 0 ? -1 : 1, k < 2 ? -1 : 1));
            const double w = bell_dual((uv.x - c.x) / h) * bell_dual((uv.y - c.y) / h) * h * h / 16;
            if (w != 0) points.emplace_back(uv, w);
          }
      for (int t = 0; t < field.height; ++t)
        for (int s = 0; s < field.width; ++s) {
          const glm::dvec2 st = field.corner + field.pixel * (glm::dvec2(s, t) + 0.5);
          double sum = 0;
          for (const auto& [uv, w] : points) {
            const double r2 = glm::dot(st - uv, st - uv) + 625;
            sum += w * 625 / (r2 * r2);
          }
          image[t * field.width + s] = static_cast<float>(sum);
        }
    }
  return field;
}

// The exact reconstruction and eq. 14 against the closed form; the far-field model of the same lamp beside
// them.
TEST(LightField, LambertianSquare) {
  const NearLamp lamp(lambertian(1));
  const NearError error(lamp);
  std::printf("  z/side   exact    eq. 14  predicted  far field\n");
  for (const double z : {5.0, 10.0, 25.0, 50.0}) {
    const double truth = on_axis(2.5, z);
    const Vec3 x(0, 0, static_cast<float>(-z)), n(0, 0, 1);
    const double exact = lamp.exact(x, n) / truth - 1, approximate = lamp.approximate(x, n) / truth - 1;
    const double point = 25 / (z * z) / truth - 1;
    std::printf("  %5.1f  %+7.3f%% %+7.3f%% %6.2f%% %+7.2f%%\n", z / 5, 100 * exact, 100 * approximate,
                100 * error.at(x, n) / truth, 100 * point);
    EXPECT_LT(std::abs(exact), z < 10 ? 0.015 : 0.005) << z;
    EXPECT_LT(std::abs(approximate), z < 10 ? 0.02 : 0.005) << z;
    EXPECT_LT(std::abs(approximate) * truth, error.at(x, n) + 0.002 * truth)
        << z << ": pixels of h blur, too";
  }
  EXPECT_NEAR(25.0 / 25 / on_axis(2.5, 5) - 1, 0.33, 0.01) << "methods.md 2.6: the far field at one side";
  EXPECT_EQ(lamp.exact(Vec3(0, 0, 1), Vec3(0, 0, -1)), 0);
  EXPECT_EQ(lamp.approximate(Vec3(0, 0, 1), Vec3(0, 0, -1)), 0);
}

// Halving the spacing takes the error to a quarter or less.
TEST(LightField, ErrorFallsWithTheSquareOfTheSpacing) {
  const double truth = on_axis(2.5, 5);
  const Vec3 x(0, 0, -5), n(0, 0, 1);
  const double coarse = std::abs(NearLamp(lambertian(1)).approximate(x, n) / truth - 1),
               fine = std::abs(NearLamp(lambertian(0.5)).approximate(x, n) / truth - 1);
  std::printf("  h = 1: %.4f%%, h = 1/2: %.4f%%\n", 100 * coarse, 100 * fine);
  EXPECT_LT(fine, 0.3 * coarse);
}

// E z2 tends to the intensity, and the far field made of the light field is Lambert's.
TEST(LightField, FarAwayItIsAFarField) {
  const NearLamp lamp(lambertian(1));
  const double candela = 25;  // luminance 1 x area, at nadir
  for (const double z : {500.0, 5000.0})
    EXPECT_NEAR(lamp.approximate(Vec3(0, 0, static_cast<float>(-z)), Vec3(0, 0, 1)) * z * z, candela,
                0.01 * candela);
  const Photometry far = far_field(lamp, 5);
  for (const double gamma : {0.0, 20.0, 40.0})
    for (const double c : {0.0, 90.0, 130.0})
      EXPECT_NEAR(intensity_at(far, c, gamma), candela * std::cos(gamma * kPiD / 180), 0.01 * candela)
          << c << " " << gamma;
  const NearLamp half(coarser(lamp), lamp.field().spacing);
  EXPECT_EQ(half.field().columns, (lamp.field().columns + 1) / 2);
  for (const double z : {50.0, 500.0}) {
    const Vec3 x(static_cast<float>(0.2 * z), 0, static_cast<float>(-z)), n(0, 0, 1);
    EXPECT_NEAR(half.approximate(x, n) / lamp.approximate(x, n), 1, 0.01) << z;
  }
}

// Test 20: a slide projector, all light through one filter and one pixel. On a plane at z the spot lies at c
// (1 - z / d)
// + (s, t) z / d.
TEST(LightField, SpotsMoveWithDistance) {
  LightField field = make_light_field(NearBasis::bell, Vec2(-0.02f), Vec2(0.02f), 0.02, 0.5, 0.5, 100);
  const int m = 3, n = 2;
  field.irradiance[static_cast<std::size_t>(n * field.columns + m) * field.pixels() + 70 * 100 + 20] = 1;
  const NearLamp lamp(field);
  const glm::dvec2 c = field.center(m, n), st = field.corner + field.pixel * glm::dvec2(20.5, 70.5);
  for (const double z : {0.5, 1.0, 3.0}) {
    const glm::dvec2 spot = c * (1 - z / 0.5) + st * (z / 0.5);
    const Vec3 up(0, 0, 1);
    EXPECT_GT(lamp.approximate(Vec3(Vec2(spot), static_cast<float>(-z)), up), 0) << z;
    const double window = std::max(field.pixel, field.spacing * std::abs(1 - 0.5 / z));
    const glm::dvec2 beside = spot + glm::dvec2(1.01 * 0.5 * (field.pixel + window) * z / 0.5);
    EXPECT_EQ(lamp.approximate(Vec3(Vec2(beside), static_cast<float>(-z)), up), 0) << z;
  }
}

// Rays to light field to light, against the closed form; some 2000 rays a pixel.
TEST(LightField, RaysOfASquareLightAPlane) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    LightFieldBuilder builder(make_light_field(basis, Vec2(-0.05f), Vec2(0.05f), 0.02, 0.5, 0.5, 25));
    builder.add(square(0.1f, 1 << 20));
    const NearLamp lamp(std::move(builder).finish());
    const double luminance = 1 / (kPiD * 0.01);
    for (const double z : {0.1, 0.25, 1.0}) {
      const double truth = luminance * on_axis(0.05, z);
      const Vec3 x(0, 0, static_cast<float>(-z)), n(0, 0, 1);
      EXPECT_NEAR(lamp.exact(x, n) / truth, 1, 0.03) << z;
      EXPECT_NEAR(lamp.approximate(x, n) / truth, 1, 0.03) << z;
    }
  }
}

/// 1 lm from a strip along the left edge of a square of 0.1 m, in a lobe cos^20 tilted to the right: seen
/// from near the spot lies elsewhere than its far field says.
std::vector<SourceRay> torch(uint32_t count) {
  std::vector<SourceRay> out;
  const Frame lobe(glm::normalize(Vec3(0.3f, 0, -1)));
  for (uint32_t i = 0; i < count; ++i) {
    const Vec2 u = sobol_pair(i, 0, 1), v = sobol_pair(i, 1, 1);
    const float c = std::pow(1 - v.x, 1.0f / 21), s = std::sqrt(1 - c * c);
    const Vec3 d = lobe.to_world(Vec3(s * std::cos(2 * kPi * v.y), s * std::sin(2 * kPi * v.y), c));
    if (d.z < 0)
      out.push_back({Vec3(-0.05f + 0.03f * u.x, 0.1f * u.y - 0.05f, 0), d, 1.0f / static_cast<float>(count)});
  }
  return out;
}

// On walls at 0.5 to 10 times the lamp's size, against its own rays where they land; the far field of the
// same rays beside it. The prediction covers the error of eq. 14 (rays' noise
// added) on 95 % of the lit cells.
TEST(LightField, AgreesWithBruteForceFromNear) {
  constexpr int kCells = 12;
  const auto rays = torch(1 << 21);
  LightFieldBuilder builder(
      make_light_field(NearBasis::spline, Vec2(-0.05f), Vec2(0.05f), 0.01, 0.25, 0.5, 80));
  FarFieldBins bins(72, 90);
  builder.add(rays);
  bins.add(rays);
  EXPECT_LT(builder.lost(), 0.01);
  const NearLamp lamp(std::move(builder).finish());
  const NearError error(lamp);
  const Photometry far = bins.table();
  std::printf("  distance/size  exact   eq. 14  far field   covered\n");
  for (const double times : {0.5, 1.0, 2.0, 5.0, 10.0}) {
    const double z = 0.1 * times, width = 0.1 + 1.5 * z, cell = width / kCells;
    std::vector<double> landed(kCells * kCells), hits(kCells * kCells);
    for (const SourceRay& ray : rays) {
      const glm::dvec3 p =
          glm::dvec3(ray.position) + glm::dvec3(ray.direction) * (z / -static_cast<double>(ray.direction.z));
      const glm::dvec2 at = (glm::dvec2(p) + glm::dvec2(0.5 * width - 0.3 * z + 0.03, 0.5 * width)) / cell;
      if (!(at.x >= 0 && at.y >= 0 && at.x < kCells && at.y < kCells)) continue;
      const auto i = static_cast<std::size_t>(at.y) * kCells + static_cast<std::size_t>(at.x);
      landed[i] += static_cast<double>(ray.flux) / (cell * cell), ++hits[i];
    }
    double exact2 = 0, near2 = 0, far2 = 0, squares = 0, covered = 0, lit = 0;
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x) {
        const auto i = static_cast<std::size_t>(y * kCells + x);
        double exact = 0, approximate = 0, point = 0, predicted = 0;
        for (int k = 0; k < 4; ++k) {  // mean over the cell
          const Vec3 at(static_cast<float>((x + 0.25 + 0.5 * (k % 2)) * cell - 0.5 * width + 0.3 * z - 0.03),
                        static_cast<float>((y + 0.25 + 0.5 * (k / 2)) * cell - 0.5 * width),
                        static_cast<float>(-z));
          const Vec3 up(0, 0, 1);
          exact += 0.25 * lamp.exact(at, up, 2), approximate += 0.25 * lamp.approximate(at, up);
          predicted += 0.25 * error.at(at, up);
          const float d = glm::length(at);
          point += 0.25 * intensity(far, at / d) * z / std::pow(static_cast<double>(d), 3);
        }
        squares += landed[i] * landed[i];
        exact2 += std::pow(exact - landed[i], 2), near2 += std::pow(approximate - landed[i], 2);
        far2 += std::pow(point - landed[i], 2);
        if (hits[i] < 100) continue;
        ++lit;
        covered += std::abs(approximate - landed[i]) <= predicted + 3 * landed[i] / std::sqrt(hits[i]);
      }
    const auto share = [&](double v) { return std::sqrt(v / squares); };
    std::printf("  %12.1f %6.2f%% %7.2f%% %9.1f%% %8.0f%%\n", times, 100 * share(exact2), 100 * share(near2),
                100 * share(far2), 100 * covered / lit);
    EXPECT_LT(share(near2), 0.06) << times;
    EXPECT_LT(share(exact2), 0.06) << times;
    EXPECT_GT(share(far2), times < 3 ? 0.2 : 0) << times;
    EXPECT_GE(covered, 0.95 * lit) << times;
  }
}

TEST(LightField, FileComesBack) {
  const LightField field = noise(NearBasis::spline);
  const auto file = std::filesystem::temp_directory_path() / "sconce-light-field.exr";
  write_light_field(file, field);
  const LightField again = read_light_field(file);
  std::filesystem::remove(file);
  EXPECT_EQ(again.basis, field.basis);
  EXPECT_EQ(again.columns, field.columns);
  EXPECT_EQ(again.rows, field.rows);
  EXPECT_NEAR(again.spacing, field.spacing, 1e-9);
  EXPECT_NEAR(again.first.x, field.first.x, 1e-8);
  EXPECT_NEAR(again.corner.y, field.corner.y, 1e-7);
  EXPECT_NEAR(again.pixel, field.pixel, 1e-8);
  EXPECT_EQ(again.irradiance, field.irradiance);
}

// Floats as they are, halves to 1/2048, sRGBE to 1/127 of the largest of three (terms, or colours), zeros and
// what had been coded once exactly; flux to what values do.
TEST(LightField, EveryCodingComesBack) {
  const auto file = std::filesystem::temp_directory_path() / "sconce-light-field-codings.exr";
  for (const bool grey : {true, false}) {
    LightField field = noise(NearBasis::bell);
    for (std::size_t i = 0; i < field.irradiance.size(); i += 7) field.irradiance[i] = 0;
    for (int c = 0; c < 3 && !grey; ++c)
      for (const float v : field.irradiance) field.color.push_back(c == 1 ? 3 * v : c == 2 ? 0.1f - v : v);
    if (!grey) set_luminance(field);
    const std::vector<float>& values = grey ? field.irradiance : field.color;
    const std::size_t terms = field.terms(), pixels = field.pixels();
    for (const FieldCoding coding : {FieldCoding::full, FieldCoding::half, FieldCoding::srgbe}) {
      write_light_field(file, field, coding);
      const LightField again = read_light_field(file);
      EXPECT_EQ(again.is_grey(), grey);
      const std::vector<float>& back = grey ? again.irradiance : again.color;
      ASSERT_EQ(back.size(), values.size());
      if (coding == FieldCoding::full) {
        EXPECT_EQ(back, values);
        EXPECT_EQ(again.irradiance, field.irradiance);
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t plane = i / pixels, pixel = i % pixels;
        float most = std::abs(values[i]);  // of those that share an exponent
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t other = grey ? plane / 3 * 3 + k : plane % terms + k * terms;
          if (other < values.size() / pixels) most = std::max(most, std::abs(values[other * pixels + pixel]));
        }
        const float allowed = coding == FieldCoding::srgbe ? most / 127 : std::abs(values[i]) / 2048;
        ASSERT_NEAR(back[i], values[i], allowed) << name_of(coding) << " " << i;
        if (values[i] == 0) {
          ASSERT_EQ(back[i], 0);
        }
      }
      EXPECT_NEAR(flux(again), flux(field), 2e-3 * std::abs(flux(field))) << name_of(coding);
      write_light_field(file, again, coding);
      EXPECT_EQ(read_light_field(file).irradiance, again.irradiance) << "once more changes nothing";
    }
  }
  std::filesystem::remove(file);
  EXPECT_EQ(coding_named("srgbe"), FieldCoding::srgbe);
  EXPECT_EQ(coding_named("rgbe"), std::nullopt);
}

}  // namespace
}  // namespace sconce
