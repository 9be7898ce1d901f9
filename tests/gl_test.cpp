// SPDX-License-Identifier: Apache-2.0
// Pictures by OpenGL equal the CPU's: within 1/255 after tone mapping on at least 99.5 % of the pixels
// (silhouettes), at pixel centres.
#include <gtest/gtest.h>

#include <set>

#include "bumpy_room.h"
#include "core/test_data.h"
#include "gpu/mix.h"
#include "gpu/view.h"
#include "image/io.h"
#include "mix/test_layers.h"
#include "package/test_package.h"
#include "picture/render.h"
#include "process.h"
#include "small_scenes.h"
#include "stage.h"
#include "tone/apply.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

class GlPictures : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void bake(const fs::path& scene, const char* atlas, const char* basis = "flat") {
    const auto outcome =
        test::run_sconce({"bake", scene.string(), "-o", path("x.sconce"), "--atlas", atlas, "--samples", "2",
                          "--solver", "path", "--bounces", "1", "--basis", basis, "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  /// By every curve, through the scene's first or the named camera.
  void expect_alike(const std::vector<std::string>& faders = {}, const std::string& camera = {},
                    const std::string& tier = "auto") const {
    const Package package = Package::open(path("x.sconce"));
    const MixSpec mix = make_mix(package.manifest().groups, faders, "", {});
    const std::vector<Image> pages = mix_pages(package, mix);
    const Metering metering = meter(package, mix, pages);
    const Exposure exposure = auto_exposure(metering.log_mean, metering.maximum);
    const auto cpu = app::make_stage(package, "cpu"), gl = app::make_stage(package, "gl", tier);
    for (const auto& stage : {cpu.get(), gl.get()})
      stage->draw(*find_camera(stage->scene(), camera), mix, pages,
                  {.width = 320, .height = 240, .samples = 1}, {});
    for (const ToneMapper& mapper : tone_mappers())
      EXPECT_GE(share_alike(cpu->toned(exposure, mapper), gl->toned(exposure, mapper)), 0.995) << mapper.name;
    const Image a = cpu->coverage(), b = gl->coverage();
    std::size_t alike = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) alike += a.data[i] == b.data[i] ? 1 : 0;
    EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(a.pixels())) << "coverage";
  }
  /// Of the pixels whose codes differ by at most 1.
  static double share_alike(const Image8& a, const Image8& b) {
    EXPECT_EQ(a.data.size(), b.data.size());
    std::size_t alike = 0, lit = 0;
    for (std::size_t i = 0; i < a.data.size(); i += 3) {
      int worst = 0;
      for (std::size_t c = i; c < i + 3; ++c)
        worst = std::max(worst, std::abs(int{a.data[c]} - int{b.data[c]}));
      alike += worst <= 1 ? 1 : 0;
      lit += a.data[i] > 32 ? 1 : 0;
    }
    EXPECT_GT(3 * lit, a.data.size() / 10) << "too dark to compare";
    return static_cast<double>(3 * alike) / static_cast<double>(a.data.size());
  }
  TemporaryFolder folder_;
};

TEST_F(GlPictures, OurBathroom) {
  bake(fs::path(SCONCE_SOURCE_DIR) / "scenes/bathroom.glb", "256");
  expect_alike();
  expect_alike({"window=off", "mirror=2700K,+2ev"}, "shower");
  expect_alike({}, "", "half");
}

/// What stands about every picture of a package here.
struct Shot {
  Package package;
  MixSpec mix;
  Metering metering;
  Exposure exposure;
  const ToneMapper& agx = find_tone_mapper("agx");
  View cpu;
  Camera camera;
  gpu::Context context;
  ShownScene shown;
  gpu::View gl;

  Shot(const fs::path& path, const std::string& fader, bool normal_maps = false)
      : package(Package::open(path)),
        mix(make_mix(package.manifest().groups, std::vector{fader}, "", {})),
        metering(meter(package, mix, mix_pages(package, mix))),
        exposure(auto_exposure(metering.log_mean, metering.maximum)),
        cpu(package),
        camera(cpu.camera("")),
        shown(package),
        gl(context, shown, normal_maps) {}
};

// Normal maps under directional light, both ways to mix.
TEST_F(GlPictures, NormalMapsInEveryTier) {
  write_file(path("bumpy.glb"), write_glb(test::bumpy_room(), "test"));
  bake(path("bumpy.glb"), "256", "sh1");
  expect_alike({"left=2700K,+1ev"});
  Shot shot(path("x.sconce"), "left=2700K,+1ev", true);
  auto& [package, mix, metering, exposure, agx, cpu, camera, context, shown, gl] = shot;
  const PictureParams params{.width = 320, .height = 320, .samples = 1};
  for (const ShaderTier& tier : shader_tiers()) {
    SCOPED_TRACE(tier.name);
    const EncodedLayers layers = for_tier(read_layers(package, coefficients(Basis::sh1)), tier);
    std::vector<std::vector<Image>> mixed;
    for (std::size_t c = 0; c < layers.coefficients(); ++c)
      mixed.push_back(plain_mix(layers, mix.weights, c));
    std::vector<Image> components;
    for (std::size_t page = 0; page < mixed.front().size(); ++page)
      for (std::size_t c = 1; c < mixed.size(); ++c) components.push_back(mixed[c][page]);
    const auto expected =
        tone_map(cpu.render(camera, mix, mixed.front(), params, {}, nullptr, {}, components), exposure, agx);
    const auto look = [&](const gpu::LightSource& light) {
      gl.draw(camera, mix.weights, light, params);
      return gl.toned(exposure, agx);
    };
    gpu::PixelMix pixel(context, layers, tier);
    pixel.set(mix.weights);
    EXPECT_GE(share_alike(expected, look(pixel)), 0.995);
    if (tier.f16) {
      for (const auto form : {gpu::AtlasMix::Form::fragment, gpu::AtlasMix::Form::compute}) {
        const gpu::AtlasMix atlas(context, layers, tier, form);
        atlas.mix(mix.weights);
        EXPECT_GE(share_alike(expected, look(atlas)), 0.995);
      }
    }
    const auto smooth = tone_map(cpu.render(camera, mix, mixed.front(), params), exposure, agx);
    EXPECT_LT(share_alike(expected, smooth), 0.5) << "the maps should be seen";
  }
}

/// The package's layers in another encoding.
EncodedLayers encoded_as(const Package& package, const EncodingChoice& choice) {
  std::vector<Rgb> colors;
  for (const GroupInfo& group : package.manifest().groups) colors.push_back(group.color);
  return encode_layers(std::vector(colors.size(), choice), package.manifest().pages, colors,
                       [&](std::size_t g, int page) { return package.layer(g, page); });
}

TEST_F(GlPictures, EveryEncodingInEveryTier) {
  bake(fs::path(SCONCE_SOURCE_DIR) / "scenes/bathroom.glb", "256");
  Shot shot(path("x.sconce"), "window=+2ev");
  auto& [package, mix, metering, exposure, agx, cpu, camera, context, shown, gl] = shot;
  const PictureParams params{.width = 240, .height = 160, .samples = 1};
  std::set<std::string> shaders;
  for (const char* name :
       {"f32", "f16", "exp8", "rgbe8", "srgbe8", "multi8", "bc6h", "lum:f16", "lum:exp8"}) {
    const EncodedLayers stored = encoded_as(package, parse_encoding(name));
    for (const ShaderTier& tier : shader_tiers()) {
      SCOPED_TRACE(std::string(name) + " " + std::string(tier.name));
      const EncodedLayers layers = for_tier(stored, tier);
      gpu::PixelMix light(context, layers, tier);
      if (!shaders.insert(light.glsl()).second) continue;  // 8-bit codes are the same in every tier
      const Image expected = cpu.render(camera, mix, plain_mix(layers, mix.weights), params);
      light.set(mix.weights);
      gl.draw(camera, mix.weights, light, params);
      EXPECT_GE(share_alike(tone_map(expected, exposure, agx), gl.toned(exposure, agx)), 0.995);
      // Linear, relative to each value but for what is darker than a hundredth of the mean.
      const Image linear = gl.linear();
      std::size_t alike = 0;
      // Hardware filters, of albedo too, in steps of 1/256 texel between what may differ by far more than itself.
      const float near = context.capabilities().software ? 1e-3f : 1.0f / 64;
      const auto foot = static_cast<float>(0.01 * metering.log_mean);
      for (std::size_t i = 0; i < expected.data.size(); ++i)
        alike +=
            std::abs(linear.data[i] - expected.data[i]) <= near * std::max(expected.data[i], foot) ? 1 : 0;
      EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(expected.data.size()));
    }
  }
  EXPECT_GE(shaders.size(), 13u);
}

/// Four groups across a wall, each from 4000 lux down to a 400,000th of it, in its own direction and colour.
PackageContents contrasty_wall(const std::string& encoding) {
  constexpr int kSide = 64;
  PackageContents c = test_package(4, 1, kSide, kSide);
  c.encodings.assign(4, encoding);
  for (std::size_t g = 0; g < 4; ++g)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const auto along =
            static_cast<float>(g % 2 == 0 ? x : kSide - 1 - x) + static_cast<float>(g < 2 ? y : x);
        const float e = 4000 * std::pow(400000.0f, -along / (2 * kSide - 2));
        c.layers[g][0].set_rgb(x, y, {e, (0.4f + 0.15f * static_cast<float>(g)) * e, 0.6f * e});
      }
  return c;
}

// From package to picture: no encoding, however few values it has, shows other light by OpenGL than on the
// CPU.
TEST_F(GlPictures, PackagesOf400000ToOneInEveryEncoding) {
  for (const char* name : {"f32", "f16", "exp8", "rgbe8", "srgbe8", "multi8", "bc6h", "lum:f32", "lum:f16",
                           "lum:exp8", "lum:multi8"}) {
    SCOPED_TRACE(name);
    const PackageContents contents = contrasty_wall(name);
    fs::remove_all(path("x.sconce"));
    write_package(path("x.sconce"), contents);
    expect_alike({"b=+1ev", "c=50%"});
    const EncodingChoice choice = parse_encoding(name);
    if (choice.luminance || choice.encoding->has_gain || choice.encoding->type == TexelType::bc6h) continue;
    const Image kept = Package::open(path("x.sconce")).layer(0, 0), &given = contents.layers[0][0];
    for (std::size_t i = 0; i < given.data.size(); ++i)
      ASSERT_NEAR(kept.data[i], given.data[i],
                  choice.encoding->max_relative_error * given.data[i - i % 3] + 1e-12f);
  }
}

// The block's sides lie in the source twice, one on the other: either may be seen.
TEST_F(GlPictures, CornellWithTwoLights) {
  SCONCE_NEEDS_DATA(test_data() / "glb/cornell-two-lights.glb");
  bake(test_data() / "glb/cornell-two-lights.glb", "128");
  expect_alike();
}

// A sky of an image behind the window.
TEST_F(GlPictures, Kitchen) {
  SCONCE_NEEDS_DATA(test_data() / "glb/luxcore-kitchen.glb");
  bake(test_data() / "glb/luxcore-kitchen.glb", "256");
  expect_alike();
}

// Textures with transforms, masks.
TEST_F(GlPictures, TexturedBathroom) {
  SCONCE_NEEDS_DATA(test_data() / "glb/contemporary-bathroom.glb");
  bake(test_data() / "glb/contemporary-bathroom.glb", "256");
  expect_alike();
}

TEST_F(GlPictures, VerbWritesLinearPicturesAndCoverage) {
  write_package(path("x.sconce"), test_package(2, 1, 8, 8));
  for (const std::string device : {"cpu", "gl"}) {
    const auto outcome =
        test::run_sconce({"render", path("x.sconce"), "--device", device, "--size", "32", "--samples", "4",
                          "-o", path(device + ".exr"), "--coverage", path(device + ".c.exr"), "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("\"device\": \"cpu\"") != std::string::npos, device == "cpu") << outcome.out;
  }
  const Image a = read_exr(path("cpu.exr")), b = read_exr(path("gl.exr"));
  ASSERT_EQ(a.data.size(), b.data.size());
  // The layers are linear across the wall, so that samples at other places of a pixel have about the same
  // mean.
  for (std::size_t i = 0; i < a.data.size(); ++i) ASSERT_NEAR(b.data[i], a.data[i], 2e-3f * a.data[i]);
  EXPECT_EQ(read_exr(path("gl.c.exr")).data, read_exr(path("cpu.c.exr")).data);
}

TEST_F(GlPictures, SaysThatItDrawsNoReflections) {
  PackageContents c = test_package(1, 1, 8, 8);
  c.scene.materials[0].metallic = 1;
  write_package(path("x.sconce"), c);
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"render", path("x.sconce"), "--device", "gl", "--size", "8", "-o", path("x.png")});
    const auto outcome = test::run_sconce(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err.find("draws no reflections") != std::string::npos;
  };
  EXPECT_TRUE(said({}));
  EXPECT_FALSE(said({"--no-reflections"}));
}

}  // namespace
}  // namespace sconce
