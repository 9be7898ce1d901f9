// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/files.h"
#include "core/test_data.h"
#include "image/exr.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/primaries.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A folder of this test, gone afterwards.
class Exr : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "sconce-exr-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  fs::path folder;
};

Image ramp(int width, int height, std::vector<std::string> channels) {
  Image image(width, height, std::move(channels));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.01f * static_cast<float>(i) - 3;
  return image;
}

TEST_F(Exr, FullFloatComesBackBitForBit) {
  Image image = ramp(37, 71, {"R", "G", "B", "A"});
  image.data[5] = std::numeric_limits<float>::quiet_NaN();
  image.data[6] = -kInfinity;
  image.data[7] = 1e-42f;
  image.text["sconce:unit"] = "lux";
  image.number["whiteLuminance"] = 120.5f;
  write_exr(folder / "a.exr", image, PixelType::full);
  const Image back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.channels, image.channels);
  ASSERT_EQ(back.data.size(), image.data.size());
  EXPECT_EQ(std::memcmp(back.data.data(), image.data.data(), image.data.size() * sizeof(float)), 0);
  EXPECT_EQ(back.text, image.text);
  EXPECT_EQ(back.number, image.number);
  EXPECT_EQ(back.primaries, kRec709Primaries);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Exr, HalfRoundsAndClamps) {
  Image image = ramp(5, 200, {"lamp 1.R", "lamp 1.G", "lamp 1.B"});
  image.data[0] = 1e6f, image.data[1] = -1e6f, image.data[2] = kInfinity;
  image.data[3] = 1 + 0x1p-11f, image.data[4] = 1 + 3 * 0x1p-11f;  // ties
  write_exr(folder / "a.exr", image, PixelType::half);
  const Image back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.channels, image.channels);
  EXPECT_EQ(back.data[0], 65504);
  EXPECT_EQ(back.data[1], -65504);
  EXPECT_EQ(back.data[2], kInfinity);
  EXPECT_EQ(back.data[3], 1);
  EXPECT_EQ(back.data[4], 1 + 0x1p-9f);
  for (std::size_t i = 5; i < image.data.size(); ++i)
    ASSERT_NEAR(back.data[i], image.data[i], std::abs(image.data[i]) * 0x1p-11f + 1e-7f) << i;
}

TEST_F(Exr, LayersKeepTheirOrderAndColoursComeFirst) {
  write_exr(folder / "a.exr", ramp(3, 2, {"b.G", "b.B", "b.R", "Z", "a.B", "a.R", "a.G", "a.weight"}),
            PixelType::full);
  const Image back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.channels,
            (std::vector<std::string>{"Z", "a.R", "a.G", "a.B", "a.weight", "b.R", "b.G", "b.B"}));
  EXPECT_EQ(back.at(1, 1)[5], ramp(3, 2, {"", "", "", "", "", "", "", ""}).at(1, 1)[2]);
}

TEST_F(Exr, SameImageSameBytes) {
  const Image image = ramp(64, 64, {"R", "G", "B"});
  write_exr(folder / "a.exr", image, PixelType::half);
  write_exr(folder / "b.exr", image, PixelType::half);
  const auto bytes = [](const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(folder / "a.exr"), bytes(folder / "b.exr"));
}

TEST_F(Exr, ImpossibleImagesAreRefused) {
  EXPECT_THROW(write_exr(folder / "a.exr", Image(), PixelType::full), Error);
  EXPECT_THROW(write_exr(folder / "a.exr", Image(2, 2, {"R", "R"}), PixelType::full), Error);
  Image short_one = Image::rgb(4, 4);
  short_one.data.pop_back();
  EXPECT_THROW(write_exr(folder / "a.exr", short_one, PixelType::full), Error);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Exr, UnwritablePlacesAreErrors) {
  const Image image = Image::rgb(2, 2);
  EXPECT_THROW(write_exr(folder / "none" / "a.exr", image, PixelType::half), Error);
  EXPECT_THROW(write_png(folder / "none" / "a.png", {1, 1, 3, {0, 0, 0}}), Error);
}

/// A limit on file size meets write(2) like a full disk: it writes a part, then fails.
TEST_F(Exr, FullDiskLeavesTheOldFile) {
  Image image = Image::rgb(256, 256);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = std::sin(static_cast<float>(i * i % 9973));
  write_exr(folder / "a.exr", Image::rgb(2, 2), PixelType::full);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_exr(folder / "a.exr", image, PixelType::full), Error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(read_exr(folder / "a.exr").width, 2);
}

TEST_F(Exr, CutFilesAreErrorsAtEveryLength) {
  write_exr(folder / "whole.exr", ramp(40, 40, {"R", "G", "B"}), PixelType::half);
  std::ifstream in(folder / "whole.exr", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  for (std::size_t n = 0; n < bytes.size(); n += n < 400 ? 7 : 101) {
    std::ofstream(folder / "cut.exr", std::ios::binary) << bytes.substr(0, n);
    ASSERT_THROW(read_exr(folder / "cut.exr"), Error) << n;
  }
  std::ofstream(folder / "text.exr") << "no picture";
  EXPECT_THROW(read_exr(folder / "text.exr"), NotMyFormat);
  EXPECT_THROW(read_exr(folder / "absent.exr"), Error);
}

// Deflate makes at most 1032 bytes of one. Black comes near that; what claims more is refused before memory
// is asked for it.
TEST_F(Exr, SmallFilesHoldNoLargePictures) {
  write_exr(folder / "black.exr", Image::rgb(2048, 512), PixelType::half);
  EXPECT_LT(fs::file_size(folder / "black.exr"), 2048u * 512 * 3 * 2 / 700);
  EXPECT_EQ(read_exr(folder / "black.exr").width, 2048);
  write_exr(folder / "small.exr", ramp(40, 40, {"R", "G", "B"}), PixelType::half);
  std::string bytes = read_file(folder / "small.exr");
  const int32_t right = 1999, bottom = 1999;  // 48 MB
  const std::size_t window = bytes.find("dataWindow") + sizeof "dataWindow" + sizeof "box2i" + 4;
  std::memcpy(&bytes[window + 8], &right, 4), std::memcpy(&bytes[window + 12], &bottom, 4);
  try {
    decode_exr(bytes, "small.exr");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("claims 2000 x 2000 pixels"), std::string::npos) << e.what();
  }
}

// OpenEXR would reserve what an attribute claims; 2 GB here.
TEST_F(Exr, AttributesEndWithinTheFile) {
  Image image = ramp(4, 4, {"R", "G", "B"});
  image.text["note"] = "text";
  write_exr(folder / "note.exr", image, PixelType::half);
  std::string bytes = read_file(folder / "note.exr");
  const std::size_t at = bytes.find(std::string("note\0string", 11)) + 12;
  ASSERT_EQ(bytes[at], 4);
  bytes[at + 3] = 0x7f;
  try {
    decode_exr(bytes, "note.exr");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("'note' reaches beyond the file"), std::string::npos) << e.what();
  }
}

// OpenEXR would clear a table of 8 MB first, or ask for one of gigabytes.
TEST_F(Exr, BlocksHaveTheirPlaceInTheFile) {
  write_exr(folder / "small.exr", ramp(40, 40, {"R", "G", "B"}), PixelType::half);
  const std::string whole = read_file(folder / "small.exr");
  const std::size_t window = whole.find("dataWindow") + sizeof "dataWindow" + sizeof "box2i" + 4;
  for (const int32_t lines : {100000, 16000000, 0x7fffffff}) {
    std::string bytes = whole;
    const int32_t bottom = lines - 1;
    std::memcpy(&bytes[window + 12], &bottom, 4);
    try {
      decode_exr(bytes, "small.exr");
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("claims 40 x " + std::to_string(lines) + " pixels in more blocks"),
                std::string::npos)
          << e.what();
    }
  }
}

TEST(ExrData, EveryFileOfTheCollectionsIsRead) {
  const fs::path path = test_data() / "hdr";
  SCONCE_NEEDS_DATA(path);
  int count = 0;
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(path)) {
    if (file.path().extension() != ".exr" && file.path().extension() != ".hdr") continue;
    SCOPED_TRACE(file.path().string());
    Image image;
    ASSERT_NO_THROW(image = read_image(file.path()));
    EXPECT_EQ(image.data.size(), image.pixels() * image.stride());
    ++count;
  }
  EXPECT_GE(count, 40);
}

TEST(ExrData, TinyFilesHoldTheirNumbers) {
  const fs::path path = test_data() / "hdr/magnum";
  SCONCE_NEEDS_DATA(path);
  // The same picture three times: plain, with odd windows, tiled.
  const Image plain = read_exr(path / "rgb16f.exr");
  EXPECT_EQ(plain.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(plain.data, read_exr(path / "rgb16f-custom-windows.exr").data);
  EXPECT_EQ(plain.data, read_exr(path / "rgb16f-tiled.exr").data);
  EXPECT_EQ(plain.data, read_exr(path / "rgb16f-ripmap.exr").data);
  EXPECT_EQ(plain.data, (std::vector<float>{6, 7, 8, 3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(read_exr(path / "depth32ui.exr").channels, (std::vector<std::string>{"Z"}));
  EXPECT_EQ(read_exr(path / "rgba32f-custom-channels.exr").channels[3], "tangent.handedness");
}

TEST(ExrData, AllHalfValuesPassThrough) {
  const fs::path path = test_data() / "hdr/openexr-images/TestImages/AllHalfValues.exr";
  SCONCE_NEEDS_DATA(path);
  const Image image = read_exr(path);
  std::size_t not_finite = 0;
  for (const float v : image.data) not_finite += std::isfinite(v) ? 0 : 1;
  EXPECT_EQ(not_finite, 3u * 2048u);  // exponent 31, both signs, three channels
}

TEST(ExrData, LuminanceChromaBecomesColour) {
  const fs::path path = test_data() / "hdr/openexr-images/Chromaticities";
  SCONCE_NEEDS_DATA(path);
  const Image rgb = read_exr(path / "Rec709.exr"), yc = read_exr(path / "Rec709_YC.exr");
  ASSERT_EQ(yc.channels, rgb.channels);
  EXPECT_NEAR(compare(yc, rgb).mean_ratio, 1, 2e-3);
  double worst = 0;  // chroma is stored at half resolution, luminance is not
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      worst = std::max(worst, std::abs(double{luminance(yc.rgb_at(x, y))} - luminance(rgb.rgb_at(x, y))));
  EXPECT_LT(worst, 0.02);
}

TEST(ExrData, ForeignPrimariesAreConverted) {
  const fs::path path = test_data() / "hdr/openexr-images/Chromaticities";
  SCONCE_NEEDS_DATA(path);
  const Image rgb = read_image(path / "Rec709.exr"), xyz = read_image(path / "XYZ.exr");
  EXPECT_GT(compare(read_exr(path / "XYZ.exr"), rgb).relmse, 0.001);
  const Comparison c = compare(xyz, rgb);
  EXPECT_NEAR(c.mean_ratio, 1, 1e-3);
  EXPECT_LT(c.relmse, 1e-5);  // both files are halves
  EXPECT_EQ(xyz.primaries, kRec709Primaries);
}

TEST(ExrData, DamagedFilesAreErrorsOfOneLine) {
  const fs::path path = test_data() / "conformance/openexr-damaged.tar.xz";
  SCONCE_NEEDS_DATA(path);
  std::string folder = (fs::temp_directory_path() / "sconce-damaged-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  ASSERT_EQ(std::system(("tar -xJf '" + path.string() + "' -C '" + folder + "'").c_str()), 0);
  int refused = 0, readable = 0;
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder)) {
    if (!file.is_regular_file()) continue;
    try {
      const Image image = read_image(file.path());
      EXPECT_EQ(image.data.size(), image.pixels() * image.stride()) << file.path();
      ++readable;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).rfind(file.path().string(), 0), 0u) << e.what();
      ++refused;
    }
  }
  fs::remove_all(folder);
  EXPECT_GE(refused, 80);
  EXPECT_LE(readable, 5);  // harmless ones: odd channel names, all pixels there
}

}  // namespace
}  // namespace sconce
