// SPDX-License-Identifier: Apache-2.0
// Layers of every encoding through a package.
#include "encode/layer_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "package/test_package.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

double worst(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    most = std::max(most, std::abs(double{a.data[i]} - b.data[i]) / std::abs(a.data[i]));
  return most;
}

TEST(LayerTextures, LuminancesShareInFours) {
  const EncodingChoice rgb = parse_encoding("f16"), lum = parse_encoding("lum:f16"),
                       exp = parse_encoding("lum:exp8");
  const auto textures = share_textures({lum, rgb, lum, exp, lum, lum, lum, exp});
  ASSERT_EQ(textures.size(), 4u);
  EXPECT_EQ(textures[0].groups, (std::vector<std::size_t>{0, 2, 4, 5}));
  EXPECT_EQ(textures[1].groups, (std::vector<std::size_t>{1}));
  EXPECT_EQ(textures[2].groups, (std::vector<std::size_t>{3, 7}));
  EXPECT_EQ(textures[3].groups, (std::vector<std::size_t>{6}));
}

TEST(LayerTextures, EveryEncodingComesBack) {
  for (const Encoding& e : encodings()) {
    SCOPED_TRACE(e.name);
    const TemporaryFolder folder;
    PackageContents c = test_package(2, 2, 9, 5);
    c.encodings.assign(2, std::string(e.name));
    write_package(folder / "x.sconce", c);
    const Package package = Package::open(folder / "x.sconce");
    for (std::size_t g = 0; g < 2; ++g)
      for (int p = 0; p < 2; ++p)
        EXPECT_LE(worst(c.layers[g][static_cast<std::size_t>(p)], package.layer(g, p)), 0.1);
    const LayerInfo& info = package.manifest().layers[0];
    EXPECT_LE(info.error.relative, 2 * e.max_relative_error + 1e-7);
    EXPECT_EQ(fs::path(info.file).extension(),
              e.type == TexelType::f32 || e.type == TexelType::f16 ? ".exr" : ".ktx2");
    EXPECT_EQ(package.encoded(info).encoding->name, e.name);
  }
}

/// Groups of one colour lose nothing but bits; luminance is never lost (test 28 of methods.md).
TEST(LayerTextures, PackedLuminance) {
  const TemporaryFolder folder;
  PackageContents c = test_package(6, 1, 9, 5);
  c.encodings = {"lum:f32", "lum:f16", "f16", "lum:f32", "lum:exp8", "lum:multi8"};
  const Rgb colour = Rgb(1, 2, 3) * (1 / luminance(Rgb(1, 2, 3)));
  for (GroupInfo& group : c.manifest.groups) group.color = colour;
  c.manifest.groups[3].color = Rgb(1);  // white lamp, coloured bleeding
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  EXPECT_LE(worst(c.layers[0][0], package.layer(0, 0)), 1e-6);
  EXPECT_LE(worst(c.layers[1][0], package.layer(1, 0)), 0x1p-11 + 1e-6);
  EXPECT_LE(worst(c.layers[4][0], package.layer(4, 0)), 0.1);
  EXPECT_LE(worst(c.layers[5][0], package.layer(5, 0)), 1e-4);
  const Image bled = package.layer(3, 0), before = c.layers[3][0];
  for (std::size_t i = 0; i < before.pixels(); ++i) {
    const Rgb a = before.rgb_at(static_cast<int>(i % 9), static_cast<int>(i / 9));
    const Rgb b = bled.rgb_at(static_cast<int>(i % 9), static_cast<int>(i / 9));
    EXPECT_NEAR(luminance(b) / luminance(a), 1, 1e-6);
    EXPECT_GT(std::abs(b.r / a.r - 1), 0.5);
  }
  const std::vector<LayerInfo>& layers = package.manifest().layers;
  EXPECT_EQ(layers[0].file, layers[3].file);
  EXPECT_EQ(layers[3].channel, 1);
  EXPECT_EQ(package.encoded(layers[3]).channels, 2);
  EXPECT_LT(layers[0].error.chroma, 0.01);
  EXPECT_GT(layers[3].error.chroma, 10);
  EXPECT_LT(layers[3].error.relative, 1e-6);
}

TEST(LayerTextures, AutoTakesTheSmallestThatIsGoodEnough) {
  const TemporaryFolder folder;
  PackageContents c = test_package(1, 1, 64, 64);
  for (float& v : c.layers[0][0].data) v /= 3;  // no halves
  c.manifest.groups[0].mean_lux = 9;
  c.encodings = {"auto"};
  std::string last;
  double bytes = 0;
  for (const double most : {0.2, 0.02, 0.0004, 1e-6}) {
    c.max_error = most;
    write_package(folder / "x.sconce", c);
    const LayerInfo info = Package::open(folder / "x.sconce").manifest().layers[0];
    EXPECT_LE(info.error.relative, most);
    const double now = parse_encoding(info.encoding).bytes_per_texel();
    EXPECT_GE(now, bytes);
    bytes = now, last = info.encoding;
  }
  EXPECT_EQ(last, "f32");
}

TEST(LayerTextures, BadNamesAndFiles) {
  EXPECT_THROW(parse_encoding("lum:rgbe8"), UsageError);
  EXPECT_THROW(parse_encoding("lum:"), UsageError);
  EXPECT_EQ(parse_encoding("lum:multi8").name(), "lum:multi8");
  EXPECT_EQ(parse_encoding("lum:f16").bytes_per_texel(), 2);
  EXPECT_EQ(parse_encoding("bc6h").bytes_per_texel(), 1);

  const TemporaryFolder folder;
  PackageContents c = test_package(1, 1, 9, 5);
  c.encodings = {"exp8"};
  write_package(folder / "x.sconce", c);
  const fs::path file = folder / "x.sconce" / "layers" / "a.0.ktx2";
  std::string bytes = read_file(file);
  bytes[bytes.size() - 8] = static_cast<char>(bytes[bytes.size() - 8] ^ 0x55);
  write_file(file, bytes);
  EXPECT_THROW(Package::open(folder / "x.sconce"), Error);
  try {
    Package::open(folder / "x.sconce", false).layer(0, 0);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("a.0.ktx2: is damaged"), std::string::npos) << e.what();
  }
}

/// The basis sh1: what reads the first coefficient alone sees a flat package.
TEST(LayerTextures, DirectionalBasis) {
  const TemporaryFolder folder;
  PackageContents c = directional_test_package(2, 2, 9, 5);
  c.encodings = {"f32", "srgbe8"};
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  EXPECT_EQ(package.manifest().basis, Basis::sh1);
  ASSERT_EQ(package.manifest().layers.size(), 16u);
  for (std::size_t k = 0; k < 4; ++k) {
    for (int p = 0; p < 2; ++p) {
      EXPECT_EQ(package.layer(0, p, k).data, c.layers[2 * k][static_cast<std::size_t>(p)].data);
      EXPECT_EQ(package.layer_info(0, p, k).error.relative, 0);
      EXPECT_LE(package.layer_info(1, p, k).error.relative, 0.05);
    }
    const std::vector<LayerTexture> textures = package.textures(k);
    ASSERT_EQ(textures.size(), 2u);
    EXPECT_EQ(textures[1].coefficient, k);
    EXPECT_EQ(decode(package.encoded(textures[1], 1)).data, package.layer(1, 1, k).data);
  }
  EXPECT_LT(package.layer(1, 0, 3).data[5], 0) << "signed";
  EXPECT_EQ(package.layer_info(0, 1).file, "a.1.exr");
  EXPECT_EQ(package.layer_info(0, 1, 2).file, "a.y.1.exr");

  const fs::path manifest = folder / "x.sconce" / "manifest.json";
  const std::string text = read_file(manifest);
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string damaged = text;
    damaged.replace(damaged.find(from), from.size(), to);
    write_file(manifest, damaged);
    try {
      Package::open(folder / "x.sconce");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error_with("\"basis\": \"sh1\"", "\"basis\": \"sh2\"").find("unknown basis 'sh2'"),
            std::string::npos);
  EXPECT_NE(error_with("\"coefficient\": 2", "\"coefficient\": 1").find("more than one page 0 of group 'a'"),
            std::string::npos);
  EXPECT_NE(error_with("\"coefficient\": 2", "\"coefficient\": 4").find("coefficient"), std::string::npos);
}

TEST(LayerTextures, UnsignedEncodingsRefuseDirections) {
  const TemporaryFolder folder;
  for (const Encoding& e : encodings())
    for (const bool luminance : {false, true}) {
      if (luminance && !e.per_channel) continue;
      PackageContents c = directional_test_package(1, 1, 4, 4);
      const std::string name = (luminance ? "lum:" : "") + std::string(e.name);
      c.encodings = {name};
      if (e.is_signed && !luminance) {
        EXPECT_NO_THROW(write_package(folder / "x.sconce", c)) << name;
      } else {
        EXPECT_THROW(write_package(folder / "x.sconce", c), Error) << name;
      }
    }
  PackageContents c = directional_test_package(1, 1, 9, 5);
  c.encodings = {std::string(kAutoEncoding)};
  c.max_error = 0.05;
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(package.layer_info(0, 0, k).encoding, "srgbe8");
    EXPECT_LE(package.layer_info(0, 0, k).error.relative, 0.05);
  }
}

}  // namespace
}  // namespace sconce
