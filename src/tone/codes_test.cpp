// SPDX-License-Identifier: Apache-2.0
#include "tone/codes.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tone/apply.h"
#include "tone/test_colors.h"

namespace sconce {
namespace {

/// Every curve, at any maximum, for any colour: one code at most, and seldom that.
TEST(Codes, AreThoseOfTheCurves) {
  std::vector<Rgb> colors = test_colors();
  colors.push_back({std::nanf(""), 0.2f, 0.3f});
  colors.push_back(Rgb(0));
  Image linear = Image::rgb(static_cast<int>(colors.size()), 1);
  for (std::size_t i = 0; i < colors.size(); ++i) linear.set_rgb(static_cast<int>(i), 0, colors[i] * 50);
  for (const ToneMapper& mapper : tone_mappers())
    for (const float maximum : {1e-4f, 0.3f, 1.0f, 16.0f, 1e5f, 1e9f}) {
      Exposure exposure;
      exposure.scale = 1 / 50.0f;
      exposure.params.maximum = maximum;
      const Image8 expected = tone_map(linear, exposure, mapper);
      const Image8 got = ToneCodes(exposure, mapper).map(linear);
      ASSERT_EQ(got.data.size(), expected.data.size());
      std::size_t other = 0;
      for (std::size_t i = 0; i < got.data.size(); ++i) {
        const int difference = std::abs(int{got.data[i]} - int{expected.data[i]});
        ASSERT_LE(difference, 1) << mapper.name << " maximum " << maximum << ": " << linear.data[i] / 50;
        other += difference != 0 ? 1 : 0;
      }
      EXPECT_LT(other, got.data.size() / 8) << mapper.name << " maximum " << maximum;
    }
}

TEST(Codes, TailsOfAnyLengthAreTheSame) {
  const ToneCodes codes({}, find_tone_mapper("agx"));
  std::vector<float> linear;
  for (const Rgb& c : test_colors()) linear.insert(linear.end(), {c.r, c.g, c.b});
  std::vector<unsigned char> all(3 * 64), some(3 * 64);
  codes.map(linear.data(), 64, all.data());
  for (std::size_t pixels = 0; pixels < 64; ++pixels) {
    std::fill(some.begin(), some.end(), 7);
    codes.map(linear.data(), pixels, some.data());
    EXPECT_TRUE(std::equal(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(3 * pixels), some.begin()));
    EXPECT_EQ(some[3 * pixels], 7) << "nothing is written behind the end";
  }
}

TEST(Codes, TableBetweenItsEdges) {
  OctaveTable table;
  constexpr std::size_t kPieces = (OctaveTable::kHigh - OctaveTable::kLow) << OctaveTable::kBits;
  for (std::size_t i = 0; i < kPieces + 2; ++i) {
    table.base.push_back(static_cast<float>(i));
    table.slope.push_back(0);
  }
  EXPECT_EQ(table(0.0f), 0);
  EXPECT_EQ(table(std::ldexp(0.999f, OctaveTable::kLow)), 0);
  EXPECT_EQ(table(std::ldexp(1.0f, OctaveTable::kLow)), 1);
  EXPECT_EQ(table(1.0f), 1 - OctaveTable::kLow * (1 << OctaveTable::kBits));
  EXPECT_EQ(table(std::ldexp(1.0f, OctaveTable::kHigh)), kPieces + 1);
  EXPECT_EQ(table(1e30f), kPieces + 1);
}

TEST(Codes, OnlyColours) {
  EXPECT_THROW(ToneCodes({}, find_tone_mapper("agx")).map(Image(2, 2, {"Y"})), Error);
}

}  // namespace
}  // namespace sconce
