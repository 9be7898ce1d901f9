// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight.h"

#include <gtest/gtest.h>

#include "scene/sun_position.h"

namespace sconce {
namespace {

const SkyKind& kind(std::string_view name) {
  for (const SkyKind& k : sky_kinds())
    if (k.name == name) return k;
  ADD_FAILURE() << name;
  return sky_kinds().front();
}

Rgb at(const Image& sky, double elevation) {  // towards -z
  return sky.rgb_at(sky.width / 2,
                    std::min(sky.height - 1, static_cast<int>((90 - elevation) / 180 * sky.height)));
}

// 2003-10-17 12:30:30 at UTC-7, 39.742476 N 105.1786 W: I. Reda, A. Andreas, Solar position algorithm, NREL
// 2004, table A5.1: azimuth 194.34024, elevation 39.872046 without refraction.
TEST(SunPosition, NrelsExample) {
  const auto time = parse_time("2003-10-17T12:30:30-07:00", -105.1786);
  ASSERT_TRUE(time);
  EXPECT_EQ(*time, 1066419030);
  const SunPosition sun = sun_position(*time, 39.742476, -105.1786);
  EXPECT_NEAR(sun.elevation, 39.872046, 0.02);
  EXPECT_NEAR(sun.azimuth, 194.34024, 0.02);
}

TEST(SunPosition, SolsticeEquinoxAndPoles) {
  // At noon the elevation is 90 - latitude + declination; 23.44 degrees at the solstice.
  double highest = 0;
  for (int minute = 0; minute < 1440; ++minute)
    highest =
        std::max(highest, sun_position(*parse_time("2026-06-21T00:00Z", 0) + 60 * minute, 48, 11).elevation);
  EXPECT_NEAR(highest, 90 - 48 + 23.437, 0.01);
  EXPECT_NEAR(sun_position(*parse_time("2026-03-20T14:46Z", 0), 90, 0).elevation, 0, 0.02);  // equinox
  EXPECT_NEAR(sun_position(*parse_time("2026-12-21T12:00Z", 0), -90, 0).elevation, 23.43, 0.02);
}

TEST(SunPosition, TimesAndDirections) {
  EXPECT_EQ(parse_time("1970-01-01 00:00Z", 50), 0);
  EXPECT_EQ(parse_time("1970-01-01T01:00+01:00", 50), 0);
  EXPECT_EQ(parse_time("1970-01-01T01:00", 15), 0);  // of the meridian
  for (const char* bad : {"", "now", "2026-13-01T00:00", "2026-02-30T00:00", "2026-02-01T25:00",
                          "2026-02-01T05:00x", "2026-02-01T05:00+2"})
    EXPECT_FALSE(parse_time(bad, 0)) << bad;
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-6f; };
  EXPECT_TRUE(near(towards_sun({0, 0}), {0, 0, -1}));  // north
  EXPECT_TRUE(near(towards_sun({0, 90}), {1, 0, 0}));  // east
  EXPECT_TRUE(near(towards_sun({90, 0}), {0, 1, 0}));
  EXPECT_TRUE(near(towards_sun({0, 0}, 90), {1, 0, 0}));
}

// L = Lz (1 + 2 sin) / 3 gives E = 7 pi / 9 Lz.
TEST(Daylight, OvercastSkyInClosedForm) {
  const Image sky = sky_picture(kind("cie-overcast"), {});
  EXPECT_NEAR(horizontal_illuminance(sky), 10000, 1);
  const float zenith = 10000 * 9 / (7 * kPi);
  EXPECT_NEAR(luminance(at(sky, 89.9)), zenith, 0.001f * zenith);
  EXPECT_NEAR(luminance(at(sky, 0.3)), zenith / 3, 0.01f * zenith);
  EXPECT_NEAR(luminance(at(sky, -45)), 0.2f * 10000 / kPi, 1);
  EXPECT_NEAR(horizontal_illuminance(sky_picture(kind("cie-overcast"), {}, 500)), 500, 0.1);
}

// Luminance over the zenith's of CIE's clear sky, sun at 45 degrees: the formula of ISO 15469 by hand.
TEST(Daylight, ClearSkyIsBrightAroundTheSun) {
  Daylight daylight;
  daylight.sun = towards_sun({45, 0});
  const Image sky = sky_picture(kind("cie-clear"), daylight);
  EXPECT_NEAR(horizontal_illuminance(sky), 800 + 15500 * std::sqrt(std::sin(kPi / 4)), 2);
  const auto gradation = [](double c) { return 1 - std::exp(-0.32 / c); };
  const auto indicatrix = [](double chi) {
    return 1 + 10 * (std::exp(-3 * chi) - std::exp(-1.5 * 3.14159265)) + 0.45 * std::cos(chi) * std::cos(chi);
  };
  const double quarter = 3.14159265 / 4;
  const double expected = gradation(std::cos(quarter)) * indicatrix(0) / (gradation(1) * indicatrix(quarter));
  EXPECT_NEAR(luminance(at(sky, 44.9)) / luminance(at(sky, 89.9)), expected, 0.03 * expected);  // pixels of 0.7 degrees
}

// Preetham et al. 1999: zenith luminance of turbidity 2 with the sun at 30 degrees from the zenith.
TEST(Daylight, PreethamsZenith) {
  Daylight daylight;
  daylight.turbidity = 2;
  daylight.sun = towards_sun({60, 90});
  const Image sky = sky_picture(kind("preetham"), daylight);
  const double chi = (4.0 / 9 - 2.0 / 120) * (3.14159265 - 2 * 3.14159265 / 6);
  const double zenith = 1000 * ((4.0453 * 2 - 4.9710) * std::tan(chi) - 0.2155 * 2 + 2.4192);
  EXPECT_NEAR(luminance(at(sky, 89.9)), zenith, 0.01 * zenith);
  const Rgb blue = at(sky, 60);  // to the north, away from the sun
  EXPECT_GT(blue.b, 1.3f * blue.r);
  EXPECT_GT(horizontal_illuminance(sky), 5000);
  EXPECT_LT(horizontal_illuminance(sky), 30000);
}

TEST(Daylight, SunOfAClearDay) {
  EXPECT_NEAR(clear_sun_illuminance(90), 127500 * std::exp(-0.21), 1);
  EXPECT_EQ(clear_sun_illuminance(-1), 0);
}

}  // namespace
}  // namespace sconce
