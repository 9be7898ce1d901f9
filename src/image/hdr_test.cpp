// SPDX-License-Identifier: Apache-2.0
#include "image/hdr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/files.h"
#include "core/test_data.h"
#include "image/io.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

Image decode(const std::string& text) {
  return decode_hdr({reinterpret_cast<const unsigned char*>(text.data()), text.size()}, "test.hdr");
}

const std::string kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
/// Six pixels whose red mantissas are 10 ... 15; exponent 136 makes them integers and a half.
const std::string kSix = "\x0a\1\1\x88\x0b\1\1\x88\x0c\1\1\x88\x0d\1\1\x88\x0e\1\1\x88\x0f\1\1\x88";

std::vector<int> reds(const Image& image) {
  std::vector<int> out;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) out.push_back(static_cast<int>(image.at(x, y)[0]));
  return out;
}

TEST(Hdr, MantissasGetTheirHalfStep) {
  const Image image = decode(kHead + "-Y 2 +X 3\n" + kSix);
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.data[0], 10.5f);
  EXPECT_EQ(image.data[1], 1.5f);
  EXPECT_EQ(decode(kHead + "-Y 1 +X 1\n" + std::string("\7\7\7\0", 4)).data[0], 0);
}

TEST(Hdr, AllEightOrientations) {
  using V = std::vector<int>;
  EXPECT_EQ(reds(decode(kHead + "-Y 2 +X 3\n" + kSix)), (V{10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(reds(decode(kHead + "-Y 2 -X 3\n" + kSix)), (V{12, 11, 10, 15, 14, 13}));
  EXPECT_EQ(reds(decode(kHead + "+Y 2 +X 3\n" + kSix)), (V{13, 14, 15, 10, 11, 12}));
  EXPECT_EQ(reds(decode(kHead + "+Y 2 -X 3\n" + kSix)), (V{15, 14, 13, 12, 11, 10}));
  // Columns: the first runs down at the left.
  EXPECT_EQ(reds(decode(kHead + "+X 2 -Y 3\n" + kSix)), (V{10, 13, 11, 14, 12, 15}));
  EXPECT_EQ(reds(decode(kHead + "+X 2 +Y 3\n" + kSix)), (V{12, 15, 11, 14, 10, 13}));
  EXPECT_EQ(reds(decode(kHead + "-X 2 -Y 3\n" + kSix)), (V{13, 10, 14, 11, 15, 12}));
  EXPECT_EQ(reds(decode(kHead + "-X 2 +Y 3\n" + kSix)), (V{15, 12, 14, 11, 13, 10}));
}

TEST(Hdr, ExposureAndColourCorrectionAreTakenOut) {
  const Image image = decode("#?RADIANCE\nEXPOSURE=2\nEXPOSURE=5\nCOLORCORR=1 2 0.5\n\n-Y 2 +X 3\n" + kSix);
  EXPECT_FLOAT_EQ(image.data[0], 1.05f);
  EXPECT_FLOAT_EQ(image.data[1], 0.075f);
  EXPECT_FLOAT_EQ(image.data[2], 0.3f);
}

TEST(Hdr, XyzWhiteIsWhite) {
  // D65 in XYZE: 0.9505, 1, 1.089 of 100.
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
  const Image image = decode(head + "\x5f\x64\x6d\x88");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.data[static_cast<std::size_t>(c)], 100.5, 1.2);
}

TEST(Hdr, RunLengths) {
  // New coding: 9 pixels, red a run, green literals, blue and exponent runs.
  const std::string modern = kHead + "-Y 1 +X 9\n" + std::string("\2\2\0\x09", 4) + "\x89\x14" +
                             std::string("\x09\1\2\3\4\5\6\7\x08\x09", 10) + "\x89\x1e" + "\x89\x88";
  const Image image = decode(modern);
  for (int x = 0; x < 9; ++x) EXPECT_EQ(image.rgb_at(x, 0), Rgb(20.5f, static_cast<float>(x) + 1.5f, 30.5f));
  // Old coding: one pixel, then 2 + 1 * 256 repetitions in two counts.
  const std::string old = kHead + "-Y 1 +X 259\n" + "\x14\x15\x16\x88" + "\1\1\1\2" + "\1\1\1\1";
  EXPECT_EQ(decode(old).rgb_at(258, 0), Rgb(20.5f, 21.5f, 22.5f));
}

TEST(Hdr, DamageIsAnError) {
  EXPECT_THROW(decode("no picture"), NotMyFormat);
  EXPECT_THROW(decode(""), NotMyFormat);
  EXPECT_THROW(decode(kHead), Error);
  EXPECT_THROW(decode(kHead + "-Y 2 +X 0\n"), Error);
  EXPECT_THROW(decode(kHead + "-Y 2 +Y 3\n" + kSix), Error);
  EXPECT_THROW(decode(kHead + "-Y 99999999 +X 99999999\n" + kSix), Error);
  EXPECT_THROW(decode(kHead + "-Y 2 +X 4\n" + kSix), Error);
  EXPECT_THROW(decode(kHead + "-Y 1 +X 9\n" + std::string("\2\2\0\x09\x8a\1", 6)), Error);
  EXPECT_THROW(decode(kHead + "-Y 1 +X 2\n\1\1\1\2"), Error);
  EXPECT_THROW(decode("#?RADIANCE\nFORMAT=64-bit\n\n-Y 2 +X 3\n" + kSix), Error);
}

/// Radiance's own extremes of its test picture: x, y from the bottom left, radiances.
TEST(HdrData, ExtremesAsRadianceNamesThem) {
  const fs::path path = test_data() / "hdr/radiance-tonemap/ref";
  SCONCE_NEEDS_DATA(path);
  const Image image = read_hdr(path / "test.hdr");
  std::ifstream in(path / "test_extrema.txt");
  int x = 0, y = 0, count = 0;
  double r = 0, g = 0, b = 0;
  while (in >> x >> y >> r >> g >> b) {
    const Rgb c = image.rgb_at(x, image.height - 1 - y);
    EXPECT_NEAR(c.r, r, 0.001 * r);  // three digits are printed
    EXPECT_NEAR(c.g, g, 0.0015 * g);
    EXPECT_NEAR(c.b, b, 0.0015 * b);
    ++count;
  }
  EXPECT_EQ(count, 2);
}

TEST(HdrData, EveryCutIsAnError) {
  const fs::path path = test_data() / "hdr/polyhaven/dancing_hall_1k.hdr";
  SCONCE_NEEDS_DATA(path);
  const std::string bytes = read_file(path);
  EXPECT_EQ(decode(bytes).width, 1024);
  for (std::size_t n = 0; n < bytes.size(); n += n < 200 ? 9 : bytes.size() / 20)
    EXPECT_THROW(decode(bytes.substr(0, n)), Error) << n;
}

}  // namespace
}  // namespace sconce
