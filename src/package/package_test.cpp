// SPDX-License-Identifier: Apache-2.0
#include "package/package.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "core/error.h"
#include "core/files.h"
#include "package/test_package.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

std::string open_error(const fs::path& path) {
  try {
    Package::open(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_file(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  write_file(file, text.replace(at, from.size(), to));
}

TEST(Package, FloatLayersComeBackBitForBit) {
  const TemporaryFolder folder;
  const PackageContents c = test_package(3, 2, 9, 5);
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  for (std::size_t g = 0; g < 3; ++g)
    for (int p = 0; p < 2; ++p) {
      const Image layer = package.layer(g, p);
      EXPECT_EQ(layer.data, c.layers[g][static_cast<std::size_t>(p)].data);
      EXPECT_EQ(layer.channels, (std::vector<std::string>{"R", "G", "B"}));
      EXPECT_EQ(layer.text.at("sconce:unit"), "lux");
    }
  EXPECT_EQ(package.receivers(1).data, c.receivers[1].data);
  EXPECT_EQ(package.noise(1).data, c.noise[1].data);
  EXPECT_EQ(package.noise(1).stride(), 3u);
  const Scene scene = package.scene();
  EXPECT_EQ(scene.groups.size(), 3u);
  EXPECT_EQ(scene.meshes[0].positions, c.scene.meshes[0].positions);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing stays beside it";
}

// NaN and infinity never enter a package, whatever the image and the encoding; the line says where.
TEST(Package, WhatIsNotFiniteIsRefused) {
  const TemporaryFolder folder;
  const std::string path = (folder / "x.sconce").string();
  const auto error_of = [&](const PackageContents& c) {
    try {
      write_package(path, c);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const char* encoding : {"f32", "f16", "exp8", "rgbe8", "bc6h", "lum:f16", "auto"}) {
    PackageContents c = test_package(2, 2, 8, 8);
    c.encodings.assign(2, encoding);
    EXPECT_EQ(error_of(c), "no error") << encoding;
    c.layers[1][1].at(3, 2)[2] = kNaN;
    const std::string line = error_of(c);
    EXPECT_TRUE(line.starts_with(path + "/layers/")) << line;
    EXPECT_TRUE(line.ends_with(": layer 'b' is not a number at texel (3, 2) of page 1")) << line;
  }
  EXPECT_NO_THROW(Package::open(path));  // the last one that was whole
  const auto refused = [&](auto&& spoil, const std::string& what) {
    PackageContents c = directional_test_package(2, 1, 8, 8);
    c.raw = c.layers, c.raw_noise = c.noise;
    spoil(c);
    const std::string line = error_of(c);
    EXPECT_NE(line.find(what + " at texel (1, 0) of page 0"), std::string::npos) << line;
  };
  refused([](auto& c) { c.layers[3][0].at(1, 0)[0] = kInfinity; }, "layer 'b'.x is infinite");
  refused([](auto& c) { c.raw[0][0].at(1, 0)[1] = -kInfinity; }, "layer 'a' is infinite");
  refused([](auto& c) { c.noise[0].at(1, 0)[1] = kNaN; }, "noise of 'b' is not a number");
  refused([](auto& c) { c.raw_noise[0].at(1, 0)[0] = kNaN; }, "noise of 'a' is not a number");
  refused([](auto& c) { c.receivers[0].at(1, 0)[3] = kNaN; }, "weight is not a number");
  refused(
      [](auto& c) {
        Light sky;
        sky.intensity = Rgb(1e30f);
        sky.shape = SkyLight{Image::rgb(2, 1)};
        std::get<SkyLight>(sky.shape).image.at(1, 0)[0] = 1e30f;
        c.scene.lights.push_back(sky);
      },
      "the sky is infinite");
}

TEST(Package, RawLayersStandBesideDenoisedOnes) {
  const TemporaryFolder folder;
  PackageContents c = test_package(2, 2, 9, 5);
  write_package(folder / "plain.sconce", c);
  EXPECT_THROW(Package::open(folder / "plain.sconce").undenoised(), Error);

  c.raw = c.layers;
  c.raw_noise = c.noise;
  for (auto& group : c.raw)
    for (Image& page : group)
      for (float& v : page.data) v += 1;
  for (Image& page : c.raw_noise)
    for (float& v : page.data) v = 0.25f;
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce"), raw = package.undenoised();
  EXPECT_EQ(package.layer(1, 1).data, c.layers[1][1].data);
  EXPECT_EQ(package.noise(1).data, c.noise[1].data);
  EXPECT_EQ(raw.layer(1, 1).data, c.raw[1][1].data);
  EXPECT_EQ(raw.noise(1).data, c.raw_noise[1].data);

  fs::remove(folder / "x.sconce" / "raw" / package.manifest().raw[0].file);
  EXPECT_THROW(Package::open(folder / "x.sconce"), Error);
}

TEST(Package, HalfLayersAreWithinHalfAStep) {
  const TemporaryFolder folder;
  PackageContents c = test_package(1, 1, 16, 16);
  c.encodings = {"f16"};
  for (std::size_t i = 0; i < c.layers[0][0].data.size(); ++i)
    c.layers[0][0].data[i] = std::exp(static_cast<float>(i) / 768.0f * 19.0f - 8.0f);
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  EXPECT_EQ(package.manifest().layers[0].encoding, "f16");
  const Image layer = package.layer(0, 0);
  for (std::size_t i = 0; i < layer.data.size(); ++i)
    EXPECT_NEAR(layer.data[i], c.layers[0][0].data[i], c.layers[0][0].data[i] * 0x1p-11f);
}

TEST(Package, SunlightBeyondHalvesIsKeptInFloats) {
  const TemporaryFolder folder;
  PackageContents c = test_package(2, 1, 4, 4);
  c.encodings = {"f16", "f16"};
  c.layers[1][0].set_rgb(2, 2, {100000, 90000, 80000});
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  EXPECT_EQ(package.manifest().layers[0].encoding, "f16");
  EXPECT_EQ(package.manifest().layers[1].encoding, "f32");
  EXPECT_EQ(package.layer(1, 0).rgb_at(2, 2), Rgb(100000, 90000, 80000));
}

TEST(Package, OddGroupNames) {
  const TemporaryFolder folder;
  PackageContents c = test_package(3, 1, 4, 4);
  c.manifest.groups[0].name = "Ceiling Lamp.001";
  c.manifest.groups[1].name = "Ceiling_Lamp_001";
  c.manifest.groups[2].name = "../../up";
  write_package(folder / "x.sconce", c);
  const Package package = Package::open(folder / "x.sconce");
  for (std::size_t g = 0; g < 3; ++g) EXPECT_EQ(package.layer(g, 0).data, c.layers[g][0].data);
}

TEST(Package, SkyComesBackAsRadiance) {
  const TemporaryFolder folder;
  PackageContents c = test_package(1, 1, 4, 4);
  Light sky;
  sky.name = "dome";
  sky.group_name = "a";
  sky.intensity = {2, 3, 4};
  sky.shape = SkyLight{};
  c.scene.lights.push_back(sky);
  Image image = Image::rgb(4, 2);
  image.set_rgb(1, 1, {10, 20, 30});
  sky.shape = SkyLight{image};
  c.scene.lights.push_back(sky);
  write_package(folder / "x.sconce", c);
  const Scene scene = Package::open(folder / "x.sconce").scene();
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(std::get<SkyLight>(scene.lights[0].shape).image.rgb_at(0, 0), Rgb(2, 3, 4));
  EXPECT_EQ(std::get<SkyLight>(scene.lights[1].shape).image.rgb_at(1, 1), Rgb(20, 60, 120));
  EXPECT_EQ(scene.lights[1].intensity, Rgb(1));
  EXPECT_EQ(scene.lights[1].group, Id<LightGroup>(0));
}

TEST(Package, ReplacesAPackageAndNothingElse) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", test_package(3, 1, 4, 4));
  write_package(folder / "x.sconce", test_package(1, 1, 8, 8));
  EXPECT_EQ(Package::open(folder / "x.sconce").manifest().groups.size(), 1u);
  EXPECT_FALSE(fs::exists(folder / "x.sconce/layers/c.0.exr"));

  fs::create_directory(folder / "mine");
  write_file(folder / "mine/letter.txt", "dear");
  EXPECT_THROW(write_package(folder / "mine", test_package(1, 1, 4, 4)), Error);
  EXPECT_TRUE(fs::exists(folder / "mine/letter.txt"));
  write_file(folder / "file", "x");
  EXPECT_THROW(write_package(folder / "file", test_package(1, 1, 4, 4)), Error);
  EXPECT_THROW(write_package(folder / "no/such/x.sconce", test_package(1, 1, 4, 4)), Error);
  EXPECT_FALSE(fs::exists(folder / "no"));
}

// A file-size limit stands in for a full disk: writing fails in the middle.
TEST(Package, FullDiskLeavesTheOldOneAndNothingElse) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", test_package(1, 1, 4, 4));
  PackageContents big = test_package(1, 1, 256, 256);
  uint32_t bits = 1;
  for (float& v : big.layers[0][0].data) v = static_cast<float>(bits = bits * 1664525u + 1013904223u);
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{64 << 10, old.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string error = "no error";
  try {
    write_package(folder / "x.sconce", big);
  } catch (const Error& e) {
    error = e.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(error.find("x.sconce/layers/a.0.exr: cannot be written"), std::string::npos) << error;
  EXPECT_EQ(Package::open(folder / "x.sconce").manifest().width, 4);
  int entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "")) ++entries;
  EXPECT_EQ(entries, 1);
}

TEST(Package, NotAPackage) {
  const TemporaryFolder folder;
  write_file(folder / "file.exr", "x");
  fs::create_directory(folder / "empty");
  EXPECT_THROW(Package::open(folder / "file.exr"), NotMyFormat);
  EXPECT_THROW(Package::open(folder / "empty"), NotMyFormat);
  EXPECT_NE(open_error(folder / "absent").find("no such package"), std::string::npos);
}

TEST(Package, EveryDamageNamesItsFile) {
  const TemporaryFolder folder;
  const fs::path path = folder / "x.sconce";
  const auto expect = [&](const char* file, const char* what) {
    const std::string error = open_error(path);
    EXPECT_EQ(error.rfind((path / file).string() + ": ", 0), 0u) << error;
    EXPECT_NE(error.find(what), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  };
  const auto fresh = [&] { write_package(path, test_package(2, 1, 4, 4)); };
  fresh();
  EXPECT_EQ(open_error(path), "no error");
  write_file(path / "manifest.json", read_file(path / "manifest.json").substr(0, 200));
  expect("manifest.json", "damaged");
  fresh();
  replace_in(path / "manifest.json", "\"version\": 1", "\"version\": 2");
  expect("manifest.json", "version 2");
  fresh();
  fs::remove(path / "layers/b.0.exr");
  expect("layers/b.0.exr", "missing");
  fresh();
  fs::remove(path / "scene.glb");
  expect("scene.glb", "missing");
  fresh();
  write_file(path / "layers/a.0.exr", read_file(path / "layers/a.0.exr") + "x");
  expect("layers/a.0.exr", "bytes");
  for (const char* file : {"layers/a.0.exr", "scene.glb", "receivers.0.exr", "noise.0.exr"}) {
    fresh();
    std::string bytes = read_file(path / file);
    bytes[bytes.size() - 3] = static_cast<char>(bytes[bytes.size() - 3] ^ 1);
    write_file(path / file, bytes);
    expect(file, "damaged");
  }
  fresh();
  replace_in(path / "manifest.json", "\"encoding\": \"f32\"", "\"encoding\": \"exp9\"");
  expect("manifest.json", "exp9");
}

TEST(Package, SizeMismatchNamesTheFile) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", test_package(1, 1, 4, 4));
  replace_in(folder / "x.sconce/manifest.json", "\"width\": 4", "\"width\": 5");
  const Package package = Package::open(folder / "x.sconce", false);
  EXPECT_THROW(package.layer(0, 0), Error);
  EXPECT_THROW(package.receivers(0), Error);
}

TEST(Package, TablesMustFitTheScene) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", test_package(1, 1, 4, 4));
  replace_in(folder / "x.sconce/manifest.json", "\"lightmap_set\": 1", "\"lightmap_set\": 2");
  EXPECT_THROW(Package::open(folder / "x.sconce").scene(), Error);
}

}  // namespace
}  // namespace sconce
