// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"

namespace sconce {
namespace {

Image constant(int width, int height, const Rgb& c) {
  Image image = Image::rgb(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, c);
  return image;
}

TEST(Compare, KnownAnswers) {
  const Image b = constant(8, 4, Rgb(2));
  Image a = b;
  EXPECT_EQ(compare(a, b).mse, 0);
  EXPECT_EQ(compare(a, b).mean_ratio, 1);
  a.set_rgb(3, 1, {2, 5, 2});
  const Comparison c = compare(a, b);
  EXPECT_NEAR(c.mse, 9.0 / 96, 1e-12);
  EXPECT_NEAR(c.relmse, 9.0 / 96 / 4.04, 1e-12);
  EXPECT_EQ(c.max, 3);
  EXPECT_NEAR(c.mean_ratio, 1 + 3 * 0.7152 / 64, 1e-6);
  const Comparison scaled = compare(constant(2, 2, Rgb(30)), constant(2, 2, Rgb(20)));
  EXPECT_NEAR(scaled.relmse, 100 / 404.0, 1e-9);
}

TEST(Compare, NotFiniteIsNeverGood) {
  Image a = constant(4, 4, Rgb(1));
  a.at(1, 1)[2] = std::numeric_limits<float>::quiet_NaN();
  const Comparison c = compare(a, constant(4, 4, Rgb(1)));
  EXPECT_EQ(c.not_finite, 1u);
  EXPECT_FALSE(c.mse <= 1e30);
  EXPECT_FALSE(c.max <= 1e30);
  EXPECT_FALSE(relative_rmse(a, constant(4, 4, Rgb(1)), nullptr, nullptr).rmse <= 1e30);
}

TEST(Compare, BlackImagesAreEqual) {
  const Comparison c = compare(Image::rgb(2, 2), Image::rgb(2, 2));
  EXPECT_EQ(c.relmse, 0);
  EXPECT_EQ(c.mse, 0);
}

TEST(Compare, SizesAndChannelsMustAgree) {
  EXPECT_THROW(compare(Image::rgb(2, 2), Image::rgb(2, 3)), Error);
  EXPECT_THROW(compare(Image::rgb(2, 2), Image(2, 2, {"Y"})), Error);
  EXPECT_THROW(compare(Image(), Image()), Error);
  const Image mask(3, 3, {"Y"}), picture = Image::rgb(4, 4);
  EXPECT_THROW(relative_rmse(picture, picture, nullptr, &mask), Error);
}

TEST(RelativeRmse, ConstantErrorOfFivePercent) {
  const Image s = constant(16, 12, {1, 2, 4});
  const RelativeRmse r = relative_rmse(constant(16, 12, Rgb{1, 2, 4} * 1.05f), s, nullptr, nullptr);
  // sqrt of the mean over channels of squares (0.05, 0.1, 0.2), over the channels' mean 7/3.
  EXPECT_NEAR(r.rmse, std::sqrt((0.0025 + 0.01 + 0.04) / 3) / (7.0 / 3), 1e-6);
  EXPECT_NEAR(r.mean_ratio, 1.05, 1e-6);
  EXPECT_EQ(r.kept, 12u);
  EXPECT_EQ(r.kept_pixels, 192u);
  EXPECT_NEAR(*r.boxes.at(2, 1), r.rmse, 1e-6);
}

TEST(RelativeRmse, PixelNoiseInsideABoxAverages) {
  const Image s = constant(8, 8, Rgb(1));
  Image picture = s;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) picture.set_rgb(x, y, Rgb((x + y) % 2 == 0 ? 1.5f : 0.5f));
  EXPECT_NEAR(relative_rmse(picture, s, nullptr, nullptr).rmse, 0, 1e-7);
}

TEST(RelativeRmse, ReferenceNoiseIsTakenOff) {
  // An exact picture against two noisy references: without correction the error is the noise of their mean.
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.2f);
  const Image truth = constant(400, 400, Rgb(1));
  Image s0 = truth, s1 = truth;
  for (float& v : s0.data) v += noise(random);
  for (float& v : s1.data) v += noise(random);
  const RelativeRmse r = relative_rmse(truth, s0, &s1, nullptr);
  EXPECT_NEAR(r.noise, 0.2 / 4 / std::sqrt(2.0), 5e-4);
  EXPECT_LT(r.rmse, 0.004);
  EXPECT_NEAR(relative_rmse(truth, s0, nullptr, nullptr).rmse, 0.05, 1e-3);
  // A true error of 3 % is still found under 3.5 % of noise.
  EXPECT_NEAR(relative_rmse(constant(400, 400, Rgb(1.03f)), s0, &s1, nullptr).rmse, 0.03, 1e-3);
}

TEST(RelativeRmse, MaskIsDilatedAndHalfEmptyBoxesAreDropped) {
  const Image s = constant(8, 8, Rgb(1));
  Image picture = s, mask(8, 8, {"coverage"});
  // One covered pixel at (1,1) drops 3 x 3 pixels: 7 of 16 are left in box (0,0), too few.
  *mask.at(1, 1) = 0.01f;
  picture.set_rgb(2, 2, Rgb(100));  // inside the dilation
  RelativeRmse r = relative_rmse(picture, s, nullptr, &mask);
  EXPECT_EQ(r.kept, 3u);
  EXPECT_EQ(r.kept_pixels, 55u);
  EXPECT_EQ(*r.boxes.at(0, 0), -1);
  EXPECT_EQ(r.rmse, 0);
  EXPECT_NEAR(r.mean_ratio, 1, 1e-12);
  // In the corner it drops 2 x 2: 12 of 16 are left, the box counts.
  mask = Image(8, 8, {"coverage"});
  *mask.at(0, 0) = 1;
  r = relative_rmse(picture, s, nullptr, &mask);
  EXPECT_EQ(r.kept, 4u);
  EXPECT_NEAR(*r.boxes.at(0, 0), 99.0 / 12, 1e-5);
  // Everything masked: no figure, and no limit is met.
  for (float& v : mask.data) v = 1;
  EXPECT_FALSE(relative_rmse(picture, s, nullptr, &mask).rmse <= 1e30);
}

TEST(RelativeRmse, BoxesAtTheEdgeAreSmaller) {
  const RelativeRmse r = relative_rmse(constant(9, 5, Rgb(2)), constant(9, 5, Rgb(1)), nullptr, nullptr);
  EXPECT_EQ(r.kept, 6u);
  EXPECT_NEAR(r.rmse, 1, 1e-12);
}

TEST(ErrorPicture, FramesTheWorstAndGreysTheDropped) {
  const Image s = constant(40, 40, Rgb(1));
  Image picture = s, mask(40, 40, {"coverage"});
  picture.set_rgb(21, 21, Rgb(3));
  *mask.at(1, 1) = 1;
  const RelativeRmse r = relative_rmse(picture, s, nullptr, &mask);
  const Image8 out = error_picture(picture, s, &mask, r.boxes);
  const auto pixel = [&](int x, int y) {
    const unsigned char* p = &out.data[static_cast<std::size_t>(3 * (y * 40 + x))];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(pixel(20, 20), (std::array<int, 3>{255, 32, 32}));
  EXPECT_EQ(pixel(21, 21), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(pixel(22, 22), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(pixel(0, 0), (std::array<int, 3>{96, 96, 96}));
  EXPECT_EQ(pixel(30, 5), (std::array<int, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace sconce
