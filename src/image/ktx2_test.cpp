// SPDX-License-Identifier: Apache-2.0
#include "image/ktx2.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>

#include "core/error.h"
#include "core/files.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

class Ktx2File : public testing::Test {
 protected:
  Ktx2File() {
    texture_.width = 5, texture_.height = 3, texture_.layers = 2;
    texture_.text = {{"sconce:unit", "lux"}, {"sconce:group", "Leuchte \xc3\xa4"}};
    for (std::size_t i = 0; i < texture_.bytes(); ++i) texture_.data.push_back(static_cast<std::byte>(7 * i));
  }
  ~Ktx2File() override { fs::remove(file_); }

  void expect_error(const std::string& bytes, const char* part) {
    write_file(file_, bytes);
    try {
      read_ktx2(file_);
      FAIL() << "no error: " << part;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(file_.string()), std::string::npos) << e.what();
    }
  }

  Ktx2 texture_;
  fs::path file_ = fs::temp_directory_path() / ("ktx2_test." + std::to_string(::getpid()) + ".ktx2");
};

TEST_F(Ktx2File, ComesBack) {
  for (const KtxFormat format :
       {KtxFormat::r8, KtxFormat::rg8, KtxFormat::rgb8, KtxFormat::rgba8, KtxFormat::bc6h_ufloat}) {
    texture_.format = format;
    texture_.data.resize(texture_.bytes());
    write_ktx2(file_, texture_);
    const Ktx2 back = read_ktx2(file_);
    EXPECT_EQ(back.format, format);
    EXPECT_EQ(back.width, 5);
    EXPECT_EQ(back.height, 3);
    EXPECT_EQ(back.layers, 2);
    EXPECT_EQ(back.data, texture_.data);
    EXPECT_EQ(back.text.at("sconce:group"), "Leuchte \xc3\xa4");
    EXPECT_EQ(back.text.at("KTXwriter"), "sconce");
  }
}

/// Numbers of the specification, read from the bytes.
TEST_F(Ktx2File, HeaderAndDescriptor) {
  write_ktx2(file_, texture_);
  const std::string bytes = read_file(file_);
  const auto word = [&](std::size_t at) {
    uint32_t v = 0;
    std::memcpy(&v, &bytes[at], 4);
    return v;
  };
  EXPECT_EQ(bytes.substr(0, 12), std::string("\xabKTX 20\xbb\r\n\x1a\n", 12));
  EXPECT_EQ(word(12), 37u);  // VK_FORMAT_R8G8B8A8_UNORM
  EXPECT_EQ(word(44), 3u);   // zlib
  const std::size_t dfd = word(48);
  EXPECT_EQ(word(52), word(dfd));  // its length, twice
  EXPECT_EQ(word(dfd), 4u + 24 + 4 * 16);
  EXPECT_EQ(bytes[dfd + 12], 1);                  // RGBSDA
  EXPECT_EQ(bytes[dfd + 14], 1);                  // linear
  EXPECT_EQ(word(dfd + 28 + 3 * 16) >> 24, 15u);  // the fourth sample is alpha
}

TEST_F(Ktx2File, DamageIsNamed) {
  write_ktx2(file_, texture_);
  const std::string good = read_file(file_);
  expect_error("KTX 11", "no KTX2");
  expect_error(good.substr(0, 60), "cut short");
  expect_error(good.substr(0, good.size() - 3), "cut short");
  std::string bad = good;
  bad[12] = 99;
  expect_error(bad, "texture format 99");
  bad = good;
  bad[20] = 17;
  expect_error(bad, "does not fit");
  bad = good;
  bad[good.size() - 6] = static_cast<char>(bad[good.size() - 6] + 1);
  expect_error(bad, "unpacked");
  bad = good;
  bad[44] = 0;
  expect_error(bad, "zlib");
  bad = good;
  bad[23] = 127;
  expect_error(bad, "says it is");
  bad = good;  // 65536 x 65536 x 4096 texels are refused before memory is asked for them
  const uint32_t side = 1 << 16, layers = 1 << 12;
  const uint64_t whole = uint64_t{side} * side * layers * 4;
  std::memcpy(&bad[20], &side, 4), std::memcpy(&bad[24], &side, 4), std::memcpy(&bad[32], &layers, 4);
  std::memcpy(&bad[96], &whole, 8);
  expect_error(bad, "can hold");
}

}  // namespace
}  // namespace sconce
