// SPDX-License-Identifier: Apache-2.0
// The C interface, on packages whose sums are known.
#include "runtime/sconce.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "package/points.h"
#include "package/test_package.h"

namespace sconce {
namespace {

class Runtime : public testing::Test {
 protected:
  /// Three groups, two pages of 9 x 5 texels.
  sconce_package* open(const std::vector<std::string>& encodings,
                       PackageContents c = test_package(3, 2, 9, 5)) {
    c.encodings = encodings;
    write_package(folder / "x.sconce", c);
    package = sconce_package_open((folder / "x.sconce").c_str(), message, sizeof message);
    EXPECT_NE(package, nullptr) << message;
    return package;
  }
  void TearDown() override { sconce_package_close(package); }

  TemporaryFolder folder;
  sconce_package* package = nullptr;
  char message[256] = "";
};

TEST_F(Runtime, TellsWhatThePackageIs) {
  open({"f32", "f32", "f32"});
  const sconce_atlas atlas = sconce_package_atlas(package);
  EXPECT_EQ(atlas.width, 9);
  EXPECT_EQ(atlas.height, 5);
  EXPECT_EQ(atlas.pages, 2);
  EXPECT_EQ(atlas.uv_set, 1);
  ASSERT_EQ(atlas.nodes, 1u);
  EXPECT_EQ(sconce_package_page(package, 0), 0);
  EXPECT_EQ(sconce_package_page(package, 1), -1);
  ASSERT_EQ(sconce_package_group_count(package), 3u);
  sconce_group group;
  ASSERT_EQ(sconce_package_group(package, 1, &group), 0);
  EXPECT_STREQ(group.name, "b");
  EXPECT_EQ(group.lumens, 100);
  EXPECT_EQ(sconce_package_group(package, 3, &group), 1);
}

TEST_F(Runtime, MixesBySettings) {
  open({"f32", "f16", "f32"});
  float weights[9];
  const char* const settings[] = {"a=50%", "b=+1ev"};
  ASSERT_EQ(sconce_package_weights(package, settings, 2, "off", weights, message, sizeof message), 0)
      << message;
  EXPECT_EQ(weights[0], 0.5f);
  EXPECT_EQ(weights[3], 2);
  EXPECT_EQ(weights[8], 0);
  EXPECT_EQ(sconce_package_mixed(package, 0), nullptr);
  ASSERT_EQ(sconce_package_mix(package, weights, message, sizeof message), 0) << message;
  // Texel (4, 2) of page 1: group g has (1 + g) * 2 + 4/8 + 2/16 in red, thrice that in blue.
  const float* texel = sconce_package_mixed(package, 1) + 3 * (2 * 9 + 4);
  EXPECT_NEAR(texel[0], 0.5f * 2.625f + 2 * 4.625f, 1e-2);
  EXPECT_NEAR(texel[2], 3 * texel[0], 1e-2);
  EXPECT_EQ(sconce_package_mixed(package, 2), nullptr);

  const char* const wrong[] = {"bb=1"};
  EXPECT_EQ(sconce_package_weights(package, wrong, 1, nullptr, weights, message, sizeof message), 1);
  EXPECT_NE(std::string(message).find("bb"), std::string::npos) << message;
}

// Two groups, two probes a metre apart along x: e and g_y of both groups, and 3/4 of the way from one to the
// other.
TEST_F(Runtime, ProbesTakeTheMix) {
  ProbeGrid grid;
  grid.origin = {1, 2, 3};
  grid.size = {2, 1, 1};
  grid.groups = 2;
  grid.valid = {1, 1};
  grid.values = {{Rgb(100), Rgb(0), Rgb(50), Rgb(0)},
                 {Rgb(8, 0, 0), Rgb(0), Rgb(0), Rgb(4, 0, 0)},
                 {Rgb(200), Rgb(0), Rgb(90), Rgb(0)},
                 {Rgb(0), Rgb(0), Rgb(0), Rgb(0)}};
  PackageContents contents = test_package(2, 1, 9, 5);
  const auto files = print_points({}, &grid, contents.manifest.groups);
  write_package(folder / "x.sconce", std::move(contents), files);
  package = sconce_package_open((folder / "x.sconce").c_str(), message, sizeof message);
  ASSERT_NE(package, nullptr) << message;
  sconce_probes probes;
  ASSERT_EQ(sconce_package_probes(package, &probes, message, sizeof message), 0) << message;
  EXPECT_EQ(probes.size[0], 2);
  EXPECT_EQ(probes.origin[2], 3);
  EXPECT_EQ(probes.spacing, 1);
  const float weights[] = {0.5f, 0.5f, 0.5f, 1, 2, 2}, at[] = {1.75f, 9, 3};
  float light[12];
  ASSERT_EQ(sconce_probe_light(package, weights, at, light, message, sizeof message), 0) << message;
  EXPECT_NEAR(light[0], 0.5 * 175 + 0.25 * 8, 1e-4);
  EXPECT_NEAR(light[1], 0.5 * 175, 1e-4);
  EXPECT_NEAR(light[7], 0.5 * 80, 1e-4);  // g_y, green
  EXPECT_NEAR(light[9], 0.25 * 4, 1e-4);  // g_z, red
  const float down[] = {0, -1, 0}, skew[] = {0, 0.6f, 0.8f}, off[6] = {};
  float rgb[3];
  ASSERT_EQ(sconce_probe_irradiance(package, weights, at, skew, rgb, message, sizeof message), 0);
  EXPECT_NEAR(rgb[0], light[0] + 0.6f * light[6] + 0.8f * light[9], 1e-4);
  ASSERT_EQ(sconce_probe_irradiance(package, weights, at, down, rgb, message, sizeof message), 0);
  EXPECT_NEAR(rgb[2], 0.5 * (175 - 80), 1e-4);
  ASSERT_EQ(sconce_probe_irradiance(package, off, at, down, rgb, message, sizeof message), 0);
  EXPECT_EQ(rgb[1], 0);
}

TEST_F(Runtime, ComposesShadersAndGivesTheirTexels) {
  open({"f32", "lum:exp8", "multi8"});
  const sconce_shader_params params = {};
  sconce_shader* shader = sconce_shader_compose(package, &params, message, sizeof message);
  ASSERT_NE(shader, nullptr) << message;
  const std::string text = sconce_shader_text(shader);
  EXPECT_EQ(text.find("#version 450"), 0u);
  ASSERT_EQ(sconce_shader_texture_count(shader), 4u);  // multi8 has two planes
  sconce_texture texture;
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_EQ(sconce_shader_texture(shader, i, &texture), 0);
    EXPECT_NE(text.find(texture.sampler), std::string::npos);
    EXPECT_EQ(texture.images, 2);
    std::size_t bytes = 0;
    ASSERT_NE(sconce_shader_texels(shader, i, 1, &bytes), nullptr);
    const std::size_t type = texture.texels == SCONCE_TEXELS_F32 ? 4 : 1;
    EXPECT_EQ(bytes, 9u * 5 * type * static_cast<std::size_t>(texture.channels));
    EXPECT_EQ(sconce_shader_texels(shader, i, 2, &bytes), nullptr);
    if (texture.texels == SCONCE_TEXELS_F32) {  // stored as they are
      const auto* texels = static_cast<const float*>(sconce_shader_texels(shader, i, 1, nullptr));
      EXPECT_EQ(texels[3 * (2 * 9 + 4)], 2.625f);
    }
  }
  EXPECT_EQ(sconce_shader_texture(shader, 4, &texture), 1);
  const float weights[] = {1, 1, 1, 2, 2, 2, 1, 1, 1};
  float uniform[9];
  sconce_shader_weights(shader, weights, uniform);
  EXPECT_EQ(uniform[0], 1);
  sconce_group b;
  sconce_package_group(package, 1, &b);
  EXPECT_EQ(uniform[4], 2 * b.color[1]);
  sconce_shader_free(shader);
}

/// Six luminances of one encoding are two textures; in one array both have four channels.
TEST_F(Runtime, SlicesOfAnArrayAreAlike) {
  open(std::vector<std::string>(6, "lum:f16"), test_package(6, 2, 9, 5));
  const sconce_shader_params params = {"functions", "glsl330", nullptr, nullptr, 0, 0};
  sconce_shader* shader = sconce_shader_compose(package, &params, message, sizeof message);
  ASSERT_NE(shader, nullptr) << message;
  sconce_texture texture;
  ASSERT_EQ(sconce_shader_texture(shader, 0, &texture), 0);
  EXPECT_EQ(texture.array, 1);
  EXPECT_EQ(texture.images, 4);
  EXPECT_EQ(texture.channels, 4);
  for (int i = 0; i < texture.images; ++i) {
    std::size_t bytes = 0;
    const auto* halves = static_cast<const uint16_t*>(sconce_shader_texels(shader, 0, i, &bytes));
    EXPECT_EQ(bytes, 9u * 5 * 4 * 2);
    const std::set<uint16_t> third{halves[2], halves[6], halves[10]};
    EXPECT_TRUE(third.contains(0) == (third.size() == 1)) << "all nothing, or all light";
  }
  sconce_shader_free(shader);
}

TEST_F(Runtime, MistakesAreOneLine) {
  EXPECT_EQ(sconce_package_open("/nowhere.sconce", message, sizeof message), nullptr);
  EXPECT_NE(std::string(message).find("/nowhere.sconce"), std::string::npos) << message;
  EXPECT_EQ(sconce_package_open("/nowhere.sconce", nullptr, 0), nullptr);
  open({"f32", "f32", "f32"});
  const sconce_shader_params params = {"picture", "hlsl", nullptr, nullptr, 0, 0};
  EXPECT_EQ(sconce_shader_compose(package, &params, message, sizeof message), nullptr);
  EXPECT_NE(std::string(message).find("glsl450, glsl330, glsl300es"), std::string::npos) << message;
  const float weights[] = {1, 1, 1, 1, 1, 1, 1, 1, 1}, at[3] = {};
  float light[12];
  EXPECT_EQ(sconce_probe_light(package, weights, at, light, message, sizeof message), 1);
  EXPECT_NE(std::string(message).find("bake --probes"), std::string::npos) << message;
  std::filesystem::remove(folder / "x.sconce/layers/a.0.exr");
  EXPECT_EQ(sconce_package_mix(package, weights, message, sizeof message), 1);
  EXPECT_NE(std::string(message).find("a.0.exr"), std::string::npos) << message;
}

}  // namespace
}  // namespace sconce
