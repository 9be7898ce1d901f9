// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"
#include "encode/encoding.h"
#include "encode/half.h"

namespace sconce {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The value of a code by the definition of binary16.
double half_value(int code) {
  const int exponent = (code >> 10) & 31, mantissa = code & 1023;
  const double v = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return (code & 0x8000) != 0 ? -v : v;
}

TEST(Half, All65536Codes) {
  for (int code = 0; code < 65536; ++code) {
    const auto h = static_cast<uint16_t>(code);
    const float f = half_to_float(h);
    if ((code & 0x7fff) > 0x7c00) {
      ASSERT_TRUE(std::isnan(f)) << code;
      ASSERT_GT(float_to_half(f) & 0x7fff, 0x7c00) << code;
      continue;
    }
    if ((code & 0x7fff) == 0x7c00)
      ASSERT_EQ(f, code < 0x8000 ? kInfinity : -kInfinity);
    else
      ASSERT_EQ(static_cast<double>(f), half_value(code)) << code;
    ASSERT_EQ(std::signbit(f), code >= 0x8000);
    ASSERT_EQ(float_to_half(f), h) << code;
  }
}

TEST(Half, RoundsToNearestTiesToEven) {
  for (int code = 0; code < 0x7bff; ++code) {
    const double lower = half_value(code), upper = half_value(code + 1);
    const auto middle = static_cast<float>((lower + upper) / 2);  // exact: one more bit
    ASSERT_EQ(float_to_half(middle), code + (code & 1)) << code;
    ASSERT_EQ(float_to_half(std::nextafter(middle, 0.0f)), code);
    ASSERT_EQ(float_to_half(std::nextafter(middle, 1e9f)), code + 1);
    ASSERT_EQ(float_to_half(-middle), (code + (code & 1)) | 0x8000);
  }
  EXPECT_EQ(float_to_half(65519.99f), 0x7bff);
  EXPECT_EQ(float_to_half(65520.0f), 0x7c00);
  EXPECT_EQ(float_to_half(1e-30f), 0);
  EXPECT_EQ(float_to_half(-1e-30f), 0x8000);
}

TEST(Encoding, Table) {
  ASSERT_EQ(encodings().size(), 2u);
  EXPECT_EQ(encodings()[0].name, "f32");
  EXPECT_EQ(encodings()[1].name, "f16");
  EXPECT_EQ(&find_encoding("f16"), &encodings()[1]);
  EXPECT_THROW(find_encoding("f8"), UsageError);
  EXPECT_EQ(find_encoding("f16").largest, 65504.0f);
  EXPECT_NEAR(find_encoding("f16").smallest, 6.1035e-5, 1e-8);
}

/// Over every row: the promised error inside the promised range, clamping outside, NaN to 0, zero exact.
TEST(Encoding, EveryRowKeepsItsPromise) {
  for (const Encoding& e : encodings()) {
    SCOPED_TRACE(e.name);
    std::mt19937 random(7);
    const double low = std::log(double{e.smallest}), high = std::log(double{e.largest});
    Image image = Image::rgb(1000, 100);
    for (float& v : image.data) {
      v = static_cast<float>(std::exp(low + (high - low) * (random() / 4294967296.0)));
      v = std::clamp(v, e.smallest, e.largest);
      if (e.is_signed && random() % 2 == 0) v = -v;
    }
    const Image back = round_trip(image, e);
    double worst = 0;
    for (std::size_t i = 0; i < image.data.size(); ++i)
      worst =
          std::max(worst, std::abs(double{back.data[i]} - image.data[i]) / std::abs(double{image.data[i]}));
    EXPECT_LE(worst, e.max_relative_error);
    EXPECT_GE(worst, 0.9 * e.max_relative_error);  // the bound is tight

    Image odd = Image::rgb(2, 1);
    odd.data = {0, kNan, kInfinity, e.largest, e.smallest, -1};
    const Image read = round_trip(odd, e);
    EXPECT_EQ(read.data[0], 0);
    EXPECT_EQ(read.data[1], 0);
    EXPECT_GE(read.data[2], e.largest);
    EXPECT_EQ(read.data[3], e.largest);
    EXPECT_EQ(read.data[4], e.smallest);
    EXPECT_EQ(read.data[5], e.is_signed ? -1 : 0);
  }
}

TEST(Encoding, HalfClampsInsteadOfOverflowing) {
  Image image = Image::rgb(1, 1);
  image.data = {1e9f, -1e9f, 65530};
  EXPECT_EQ(round_trip(image, find_encoding("f16")).data, (std::vector<float>{65504, -65504, 65504}));
}

TEST(Encoding, ChannelsComeInThrees) {
  EXPECT_THROW(round_trip(Image(2, 1, {"Y"}), encodings()[0]), Error);
}

}  // namespace
}  // namespace sconce
