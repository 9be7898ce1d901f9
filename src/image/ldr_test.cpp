// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "image/io.h"
#include "image/ldr.h"
#include "image/primaries.h"
#include "image/webp.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

Image8 pattern(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i)
    image.data.push_back(static_cast<unsigned char>(i * 37 % 256));
  return image;
}

TEST(Png, ComesBackForEveryChannelCount) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image8 image = pattern(13, 7, channels);
    const Image8 back = decode_image8(encode_png(image), "test");
    EXPECT_EQ(back.channels, channels);
    EXPECT_EQ(back.width, 13);
    EXPECT_EQ(back.data, image.data);
  }
  EXPECT_EQ(decode_image8(encode_png(pattern(3, 3, 1)), "test", 4).channels, 4);
}

TEST(Webp, KeepsEveryByte) {
  for (const int channels : {3, 4}) {  // opacities of 0 are among them
    const Image8 image = pattern(13, 7, channels);
    EXPECT_EQ(decode_webp(encode_webp(image), "test").data, image.data) << channels;
  }
  const std::vector<unsigned char> rgba{7, 7, 7, 0, 200, 200, 200, 9};
  EXPECT_EQ(decode_webp(encode_webp({2, 1, 2, {7, 0, 200, 9}}), "test").data, rgba);
  EXPECT_TRUE(encode_webp({16384, 1, 1, std::vector<unsigned char>(16384)}).empty());
}

TEST(Png, WrongSizesAreErrors) {
  EXPECT_THROW(encode_png({2, 2, 3, {0, 0, 0}}), Error);
  EXPECT_THROW(encode_png({0, 0, 3, {}}), Error);
}

TEST(Png, LinearIsSrgbDecoded) {
  const Image image = decode_linear(encode_png({2, 1, 4, {0, 128, 255, 51, 10, 11, 12, 255}}), "test");
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(image.data[0], 0);
  EXPECT_NEAR(image.data[1], 0.2158605, 1e-6);
  EXPECT_EQ(image.data[2], 1);
  EXPECT_NEAR(image.data[3], 0.2, 1e-6);
}

TEST(Picture, DamagedOrForeignBytes) {
  const std::vector<unsigned char> png = encode_png(pattern(64, 64, 3));
  for (std::size_t n = 8; n + 20 < png.size(); n += 97)
    EXPECT_THROW(decode_image8(std::span(png).first(n), "cut.png"), Error) << n;
  const unsigned char text[] = "no picture at all";
  EXPECT_THROW(decode_image8(text, "text"), NotMyFormat);
  EXPECT_THROW(decode_image8({}, "empty"), NotMyFormat);
}

TEST(Picture, ByContentNotByName) {
  std::string folder = (fs::temp_directory_path() / "sconce-ldr-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const fs::path file = fs::path(folder) / "picture.exr";
  write_png(file, pattern(4, 4, 3));
  EXPECT_EQ(read_image(file).channels.size(), 3u);
  std::ofstream(file) << "text";
  EXPECT_THROW(read_image(file), Error);
  EXPECT_THROW(read_image(fs::path(folder) / "absent.png"), Error);
  EXPECT_THROW(read_image(folder), Error);
  fs::remove_all(folder);
}

TEST(RgbPart, PicksColoursLayersAndSingleChannels) {
  Image rgba(1, 1, {"A", "R", "G", "B"});
  rgba.data = {9, 1, 2, 3};
  EXPECT_EQ(rgb_part(rgba, "x").data, (std::vector<float>{1, 2, 3}));
  Image layer(1, 1, {"lamp.R", "lamp.G", "lamp.B"});
  layer.data = {4, 5, 6};
  EXPECT_EQ(rgb_part(layer, "x").data, (std::vector<float>{4, 5, 6}));
  Image depth(1, 1, {"Z"});
  depth.data = {7};
  EXPECT_EQ(rgb_part(depth, "x").data, (std::vector<float>{7, 7, 7}));
  EXPECT_THROW(rgb_part(Image(1, 1, {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}), "x"), Error);
}

TEST(Primaries, Rec2020PureColours) {
  Image image = Image::rgb(2, 1);
  image.data = {1, 1, 1, 1, 0, 0};
  image.primaries = {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f};
  to_rec709(image);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.data[static_cast<std::size_t>(c)], 1, 1e-5);
  // BT.2087, table 2, inverse: 1.6605, -0.1246, -0.0182.
  EXPECT_NEAR(image.data[3], 1.6605, 1e-4);
  EXPECT_NEAR(image.data[4], -0.1246, 1e-4);
  EXPECT_NEAR(image.data[5], -0.0182, 1e-4);
}

// The matrix as ACES' own tools print it (Bradford, D65 to the white of ACES); white stays white.
TEST(Primaries, Acescg) {
  const ColorMatrix published{{{0.6130974024, 0.3395231462, 0.0473794514},
                               {0.0701937225, 0.9163538791, 0.0134523985},
                               {0.0206155929, 0.1095697729, 0.8698146342}}};
  const ColorMatrix m = rec709_to_acescg();
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_NEAR(m[r][0] + m[r][1] + m[r][2], 1, 1e-12);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], published[r][c], 2e-6);
  }
  Image image(1, 1, {"R", "G", "B", "lamp.R", "lamp.G", "lamp.B", "Z"});
  image.data = {1, 0, 0, 0.5f, 0.5f, 0.5f, 7};
  to_acescg(image);
  EXPECT_NEAR(image.data[0], 0.613097f, 1e-5f);
  EXPECT_NEAR(image.data[3], 0.5f, 1e-6f);
  EXPECT_NEAR(image.data[5], 0.5f, 1e-6f);
  EXPECT_EQ(image.data[6], 7);
  to_rec709(image);
  EXPECT_NEAR(image.data[0], 1, 1e-6f);
  EXPECT_NEAR(image.data[1], 0, 1e-6f);
}

}  // namespace
}  // namespace sconce
