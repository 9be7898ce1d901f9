// SPDX-License-Identifier: Apache-2.0
#include "tone/tone.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "tone/apply.h"
#include "tone/curve.h"
#include "tone/lut.h"
#include "tone/test_colors.h"

namespace sconce {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

bool in_unit(const Rgb& c) {
  return c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1;
}

TEST(Tone, TableOrderAndNames) {
  const char* expected[] = {"agx", "drago", "drago2006", "reinhard", "aces", "neutral", "linear"};
  ASSERT_EQ(tone_mappers().size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(tone_mappers()[i].name, expected[i]);
    EXPECT_EQ(&find_tone_mapper(expected[i]), &tone_mappers()[i]);
  }
  try {
    find_tone_mapper("filmic");
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_STREQ(
        e.what(),
        "unknown tone curve 'filmic' (allowed: agx, drago, drago2006, reinhard, aces, neutral, linear)");
  }
}

TEST(Tone, EveryCurveIsMonotoneOnGreysInRangeAndBlackStaysBlack) {
  for (const ToneMapper& mapper : tone_mappers()) {
    for (const float maximum : {1e-3f, 0.3f, 1.0f, 16.0f, 1e4f, 1e8f}) {
      SCOPED_TRACE(std::string(mapper.name) + " maximum " + std::to_string(maximum));
      ToneParams params;
      params.maximum = maximum;
      EXPECT_EQ(mapper.map(Rgb(0), params), Rgb(0));
      Rgb before(0);
      for (double stops = -24; stops <= 30; stops += 0.01) {
        const Rgb c = mapper.map(Rgb(static_cast<float>(std::exp2(stops))), params);
        ASSERT_TRUE(in_unit(c)) << stops;
        // One part in a million: matrices in float leave the channels that far apart.
        ASSERT_GE(c.r, before.r - 1e-6f) << stops;
        ASSERT_GE(c.g, before.g - 1e-6f) << stops;
        ASSERT_GE(c.b, before.b - 1e-6f) << stops;
        ASSERT_NEAR(c.r, c.g, 2e-3f);
        ASSERT_NEAR(c.r, c.b, 2e-3f);
        before = c;
      }
    }
  }
}

TEST(Tone, AnyColourIsFiniteAndInRange) {
  const float values[] = {0.0f, -0.0f, -1.0f, 1e-30f,    1e-6f,      0.18f, 1.0f,
                          4.0f, 1e4f,  1e30f, kInfinity, -kInfinity, kNan};
  for (const ToneMapper& mapper : tone_mappers())
    for (const float r : values)
      for (const float g : values)
        for (const float b : values)
          ASSERT_TRUE(in_unit(mapper.map({r, g, b}, {}))) << mapper.name << ' ' << r << ' ' << g << ' ' << b;
}

TEST(Tone, LuminanceCurvesPreserveLuminance) {
  ToneParams params;
  params.maximum = 40;
  for (int i = 0; i < 1000; ++i) {
    const float f = static_cast<float>(i) / 1000.0f;
    const Rgb c{0.02f + f, 0.05f + 0.6f * f * f, 0.03f + 0.9f * (1 - f)};
    const Rgb t709 = tone_drago(c, params), t601 = tone_drago2006(c, params), r = tone_reinhard(c, params);
    const double x709 = luminance(c) / params.adaptation, x601 = luminance(c, kRec601) / params.adaptation;
    const double m = params.maximum / params.adaptation;
    // Nothing clips here: largest channel / luminance stays below 1 / l_out.
    if (t709.max() < 1) {
      EXPECT_NEAR(luminance(t709), drago_luminance(x709, m, 0.85), 4e-7);
    }
    if (t601.max() < 1) {
      EXPECT_NEAR(luminance(t601, kRec601), drago_luminance(x601, m, 0.85), 4e-7);
    }
    if (r.max() < 1) {
      EXPECT_NEAR(luminance(r), reinhard_luminance(luminance(c), 40), 4e-7);
    }
  }
}

TEST(Drago, KnownAnswers) {
  const double x[] = {1, 10, 100, 1000}, expected[] = {0.161551, 0.469648, 0.743759, 0.910712};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(drago_luminance(x[i], 1e4, 0.85), expected[i], 5e-7);
  for (const double m : {1e-2, 1.0, 30.0, 1e4, 1e9}) {
    EXPECT_EQ(drago_luminance(0, m, 0.85), 0);
    EXPECT_NEAR(drago_luminance(m, m, 0.85), 1, 1e-14);
  }
  // The same through the mapper, grey, adaptation 0.18.
  ToneParams params;
  params.maximum = 1e4f * params.adaptation;
  for (int i = 0; i < 4; ++i) {
    const Rgb grey(static_cast<float>(x[i]) * params.adaptation);
    EXPECT_NEAR(tone_drago(grey, params).g, expected[i], 1e-6);
    EXPECT_NEAR(tone_drago2006(grey, params).g, expected[i], 1e-6);
  }
}

/// Largest fall of the curve between neighbours on a fine logarithmic grid up to the maximum.
double largest_fall(double maximum, double bias) {
  double fall = 0, before = 0;
  const double low = std::log(std::min(1e-6, maximum * 1e-3)), high = std::log(maximum);
  for (int i = 0; i <= 20000; ++i) {
    const double y =
        drago_luminance(i == 20000 ? maximum : std::exp(low + (high - low) * i / 20000), maximum, bias);
    fall = std::max(fall, before - y);
    before = y;
  }
  return fall;
}

TEST(Drago, MonotoneExactlyUpToTheLimitOfItsBias) {
  const struct {
    double bias, limit;
  } rows[] = {{0.5, 13.6},   {0.6, 44.6},    {0.7, 262},   {0.75, 1020},
              {0.8, 7.63e3}, {0.85, 2.14e5}, {0.9, 1.67e8}};
  for (const auto& row : rows) {
    SCOPED_TRACE(row.bias);
    EXPECT_LT(largest_fall(row.limit * 0.9, row.bias), 1e-12);
    EXPECT_GT(largest_fall(row.limit * 1.5, row.bias), 1e-9);
    EXPECT_NEAR(drago_smallest_bias(row.limit), row.bias, 1e-3);
  }
}

TEST(Drago, GuardKeepsItMonotoneToABillion) {
  for (double m = 1e-2; m <= 1e9; m *= 3.7)
    for (const double bias : {0.3, 0.5, 0.7, 0.85})
      ASSERT_LT(largest_fall(m, std::max(bias, drago_smallest_bias(m))), 1e-12) << m << ' ' << bias;
  EXPECT_NEAR(drago_luminance(1e4, 1e4, 0.7), 1, 1e-12);
}

TEST(Drago, InputIsClampedToTheMaximum) {
  ToneParams params;
  params.maximum = 50;
  EXPECT_EQ(tone_drago(Rgb(50), params), tone_drago(Rgb(5000), params));
}

TEST(AgX, SigmoidMeetsItsDefinition) {
  // Scale factors by which toe and shoulder meet 0 and 1 exactly.
  const double pivot = 10 / 16.5, reach = 1 - pivot;
  EXPECT_NEAR((std::pow(2 * reach / 0.5, 3.25) - 1) / std::pow(reach, 3.25), 69.86278913545539, 1e-9);
  EXPECT_NEAR((std::pow(2 * pivot / 0.5, 3.0) - 1) / std::pow(pivot, 3.0), 59.507875, 1e-9);
}

TEST(AgX, KnownAnswers) {
  // Middle grey sits on the pivot: 0.5, outset row sum 0.999828, then the 2.2 power.
  EXPECT_NEAR(tone_agx(Rgb(0.18f), {}).r, std::pow(0.5 * 0.99983, 2.2), 5e-4);
  // 6.5 stops above is white, 10 below is black.
  EXPECT_NEAR(tone_agx(Rgb(0.18f * 90.6f), {}).g, 1, 1e-3);
  EXPECT_NEAR(tone_agx(Rgb(0.18f / 1100), {}).g, 0, 1e-6);
  // Two stops above middle grey, in doubles from the definition.
  const double d = 2 / 16.5;
  const double coded = 0.5 + 2 * d * std::pow(1 + 69.86278913545539 * std::pow(d, 3.25), -1 / 3.25);
  EXPECT_NEAR(tone_agx(Rgb(0.72f), {}).g, std::pow(coded, 2.2), 5e-4);
  // Pure red: inset column (0.842479, 0.042328, 0.042376), curve, outset, power; by hand in doubles.
  const auto coded_of = [](double v) {
    const double x = (std::log2(v / 0.18) + 10) / 16.5, e = std::abs(x - 10 / 16.5);
    return x > 10 / 16.5 ? 0.5 + 2 * e * std::pow(1 + 69.86278913545539 * std::pow(e, 3.25), -1 / 3.25)
                         : 0.5 - 2 * e * std::pow(1 + 59.507875 * std::pow(e, 3.0), -1 / 3.0);
  };
  const double r = coded_of(0.842479062), g = coded_of(0.042328242), b = coded_of(0.042375655);
  const Rgb red = tone_agx({1, 0, 0}, {});
  EXPECT_NEAR(red.r, std::pow(1.196879005 * r - 0.098020881 * g - 0.099029744 * b, 2.2), 1e-5);
  EXPECT_NEAR(red.g, std::pow(-0.052896852 * r + 1.15190313 * g - 0.098961177 * b, 2.2), 1e-5);
}

TEST(Aces, KnownAnswers) {
  const auto fit = [](double v) {
    return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  };
  for (const double v : {0.01, 0.18, 1.0, 4.0})
    EXPECT_NEAR(tone_aces(Rgb(static_cast<float>(v)), {}).g, fit(v), 2e-5);
  EXPECT_NEAR(fit(0.18), 0.10559, 1e-5);
  EXPECT_EQ(tone_aces(Rgb(1000), {}), Rgb(1));
  const double r = fit(0.59719), g = fit(0.076), b = fit(0.0284);
  EXPECT_NEAR(tone_aces({1, 0, 0}, {}).r, 1.60475 * r - 0.53108 * g - 0.07367 * b, 1e-5);
}

TEST(Neutral, KnownAnswers) {
  // Below the start of compression only 4 % of Fresnel reflection is taken away.
  EXPECT_NEAR(tone_neutral(Rgb(0.5f), {}).r, 0.46, 1e-6);
  EXPECT_NEAR(tone_neutral({0.5f, 0.2f, 0.1f}, {}).g, 0.16, 1e-6);
  EXPECT_NEAR(tone_neutral(Rgb(0.04f), {}).r, 0.04 * 0.04 / 0.16, 1e-7);
  EXPECT_NEAR(tone_neutral(Rgb(0.8f), {}).r, 0.76, 1e-6);
  // Peak 2 - 0.04: new peak 1 - 0.0576 / (1.96 + 1 - 1.52) = 0.96 for grey.
  EXPECT_NEAR(tone_neutral(Rgb(2.0f), {}).r, 0.96, 1e-6);
  // A saturated one: f = 0, p = 2, pn = 1 - 0.0576 / 1.48, g = 1 / (0.15 (p - pn) + 1).
  const double pn = 1 - 0.0576 / 1.48, g = 1 / (0.15 * (2 - pn) + 1);
  const Rgb red = tone_neutral({2, 0, 0}, {});
  EXPECT_NEAR(red.r, pn, 1e-6);
  EXPECT_NEAR(red.g, pn * (1 - g), 1e-6);
}

TEST(Reinhard, WhiteIsTheMaximum) {
  ToneParams params;
  params.maximum = 8;
  EXPECT_NEAR(tone_reinhard(Rgb(8), params).r, 1, 1e-6);
  EXPECT_NEAR(tone_reinhard(Rgb(1), params).r, (1 + 1 / 64.0) / 2, 1e-6);
  EXPECT_EQ(tone_reinhard(Rgb(80), params), tone_reinhard(Rgb(8), params));
}

TEST(Exposure, AutoPutsTheLogMeanOnMiddleGrey) {
  const Exposure e = auto_exposure(20, 5000);
  EXPECT_NEAR(20 * e.scale, 0.18, 1e-6);
  EXPECT_NEAR(e.params.maximum, 45, 1e-4);
  const Exposure brighter = auto_exposure(20, 5000, 1);
  EXPECT_FLOAT_EQ(brighter.scale, 2 * e.scale);
  EXPECT_FLOAT_EQ(brighter.white_luminance(), e.white_luminance() / 2);
  // Drago sees L / L_wa.
  EXPECT_NEAR(tone_drago(Rgb(200) * e.scale, e.params).g, drago_luminance(10, 250, 0.85), 1e-6);
  const Exposure dark = auto_exposure(0, 0);
  EXPECT_TRUE(std::isfinite(dark.scale) && dark.params.maximum > 0);
}

TEST(Exposure, Ev100SaturatesAtItsLuminance) {
  EXPECT_NEAR(ev100_exposure(0, 100).scale * 1.2, 1, 1e-6);
  EXPECT_NEAR(ev100_exposure(15, 1e5).scale * 1.2 * 32768, 1, 1e-6);
  EXPECT_LT(ev100_exposure(10, 100).scale, ev100_exposure(9, 100).scale);
  EXPECT_NEAR(ev100_exposure(3, 960).params.maximum, 100, 1e-4);
}

TEST(Apply, CodesAreSrgb) {
  Image linear = Image::rgb(3, 1);
  linear.set_rgb(0, 0, Rgb(0));
  linear.set_rgb(1, 0, Rgb(0.21404114f * 50));  // sRGB code 0.5
  linear.set_rgb(2, 0, {500, kNan, -3});
  Exposure e;
  e.scale = 1 / 50.0f;
  const Image8 out = tone_map(linear, e, find_tone_mapper("linear"));
  const unsigned char expected[] = {0, 0, 0, 128, 128, 128, 255, 0, 0};
  ASSERT_EQ(out.data.size(), std::size(expected));
  for (std::size_t i = 0; i < out.data.size(); ++i) EXPECT_EQ(out.data[i], expected[i]) << i;
  EXPECT_THROW(tone_map(Image(2, 2, {"Y"}), e, find_tone_mapper("linear")), Error);
}

TEST(Lut, EqualsEveryCurveThatHasOneWithinHalfACode) {
  const std::vector<Rgb> colors = test_colors();
  int tables = 0;
  for (const ToneMapper& mapper : tone_mappers()) {
    if (mapper.curve == nullptr) continue;
    ++tables;
    for (const float maximum : {1e-4f, 0.3f, 1.0f, 16.0f, 1e5f, 1e9f}) {
      ToneParams params;
      params.maximum = maximum;
      const ToneLut lut = make_tone_lut(mapper, params);
      for (const Rgb& c : colors) {
        const Rgb expected = mapper.map(c, params), t = lut.map(c);
        for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
          ASSERT_NEAR(linear_to_srgb(t.*channel), linear_to_srgb(expected.*channel), 0.5f / 255)
              << mapper.name << " maximum " << maximum << ": " << c.r << ' ' << c.g << ' ' << c.b;
      }
    }
  }
  EXPECT_EQ(tables, 5);
}

}  // namespace
}  // namespace sconce
