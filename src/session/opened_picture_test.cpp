// SPDX-License-Identifier: Apache-2.0
#include "session/opened_picture.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/test_folder.h"
#include "image/io.h"

namespace sconce {
namespace {

/// Two lamps and light of none, over 4 x 2 pixels: key = x, fill = (y, 0, 0), rest = 0.5.
class OpenedPictureTest : public testing::Test {
 protected:
  OpenedPictureTest() {
    Image image(4, 2, {"R", "G", "B", "key.R", "key.G", "key.B", "fill.R", "fill.G", "fill.B"});
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 4; ++x) {
        const auto key = static_cast<float>(x), fill = static_cast<float>(y);
        const float values[] = {key + fill + 0.5f, key + 0.5f, key + 0.5f, key, key, key, fill, 0, 0};
        std::copy(std::begin(values), std::end(values), image.at(x, y));
      }
    write_exr(folder_ / "a.exr", image, PixelType::full);
  }
  TemporaryFolder folder_;
};

TEST_F(OpenedPictureTest, ReadsPixelsByGroups) {
  const OpenedPicture opened(folder_ / "a.exr", "");
  ASSERT_EQ(opened.picture.groups.size(), 3u);
  const auto red = luminance(Rgb(1, 0, 0));
  const std::vector<std::string> order{opened.picture.groups[0].name, opened.picture.groups[1].name};
  const std::size_t key = order[0] == "key" ? 0 : 1;
  const PictureReading reading = read_pixel(opened, {{Rgb(2), Rgb(2), Rgb(1)}}, {3.7f, 1.2f});
  EXPECT_NEAR(reading.value.r, 2 * (3 + 1) + 0.5f, 1e-5);
  EXPECT_NEAR(reading.value.g, 2 * 3 + 0.5f, 1e-5);
  EXPECT_NEAR(reading.groups[key], 6, 1e-5);
  EXPECT_NEAR(reading.groups[1 - key], 2 * red, 1e-5);
  EXPECT_NEAR(reading.groups[2], 0.5, 1e-5);
  EXPECT_NEAR(opened.means[key], 1.5, 1e-5);
  EXPECT_NEAR(opened.means[1 - key], 0.5f * red, 1e-5);
}

TEST_F(OpenedPictureTest, WishesAreOfTheSameView) {
  const OpenedPicture opened(folder_ / "a.exr", "");
  const std::vector<Rgb> unit(3, Rgb(1));
  Wishes wishes(3);
  EXPECT_THROW(wish_picture(wishes, opened, unit, Image::rgb(2, 2)), Error);
  EXPECT_THROW(wish_picture(wishes, opened, unit, Image::rgb(4, 2)), Error);  // black
}

TEST_F(OpenedPictureTest, GroupsAreNamedOnDemand) {
  EXPECT_EQ(OpenedPicture(folder_ / "a.exr", "^key$").picture.groups.size(), 2u);  // and the rest
  EXPECT_THROW(OpenedPicture(folder_ / "a.exr", "no such"), Error);
  EXPECT_THROW(OpenedPicture(folder_ / "b.exr", ""), Error);
}

}  // namespace
}  // namespace sconce
