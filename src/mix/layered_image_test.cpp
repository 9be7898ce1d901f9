// SPDX-License-Identifier: Apache-2.0
#include "mix/layered_image.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "core/test_folder.h"
#include "image/io.h"

namespace sconce {
namespace {

/// One pixel; channel i holds 1 + i.
ExrParts picture(const std::vector<std::string>& channels) {
  ExrParts parts;
  parts.image = Image(1, 1, channels);
  for (std::size_t i = 0; i < channels.size(); ++i) parts.image.data[i] = static_cast<float>(1 + i);
  parts.integer.assign(channels.size(), false);
  parts.data = parts.display = {0, 0, 1, 1};
  return parts;
}

std::vector<std::string> rgb(const std::vector<std::string>& layers) {
  std::vector<std::string> channels;
  for (const std::string& layer : layers)
    for (const char* c : {"R", "G", "B"}) channels.push_back(layer.empty() ? c : layer + "." + c);
  return channels;
}

std::vector<std::string> names(const LayeredImage& layered) {
  std::vector<std::string> names;
  for (const GroupInfo& g : layered.groups) names.push_back(g.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(LayeredImage, NamesOfEveryRenderer) {
  struct Case {
    const char* renderer;
    Names layers, groups;
  };
  const Case cases[] = {
      {"Blender Cycles",
       {"ViewLayer.Combined", "ViewLayer.Combined_key", "ViewLayer.Combined_lamp.001", "ViewLayer.DiffDir",
        "Other.Combined_key"},
       {"key", "lamp.001", "rest"}},
      {"V-Ray",
       {"", "VRayLightSelect_key", "VRayDiffuseFilter", "LightSelect_fill"},
       {"key", "fill", "rest"}},
      {"V-Ray", {"rgb", "Light Select key"}, {"key", "rest"}},
      {"LuxCore",
       {"RGB_IMAGEPIPELINE", "RADIANCE_GROUP_0", "RADIANCE_GROUP#1", "ALBEDO"},
       {"0", "1", "rest"}},
      {"Arnold", {"", "RGBA_key", "RGBA_default", "diffuse"}, {"key", "default", "rest"}},
      {"Arnold", {"RGBA", "RGBA_key", "diffuse_key"}, {"key", "rest"}},
      {"", {"", "key", "fill light"}, {"key", "fill light", "rest"}},
      {"", {"key", "fill"}, {"key", "fill"}},
      {"Arnold", {"", "RGBA_rest"}, {"rest", "beauty's rest"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.layers.back());
    const LayeredImage layered = find_layers(picture(rgb(c.layers)), "x.exr");
    EXPECT_EQ(layered.renderer, c.renderer);
    EXPECT_EQ(names(layered), c.groups);
  }
}

TEST(LayeredImage, ExpressionsOfTheUser) {
  const Names layers = rgb({"V.Combined", "V.lamps/key", "V.lamps/fill", "V.x"});
  EXPECT_EQ(names(find_layers(picture(layers), "x.exr", "lamps/(.*)")), (Names{"key", "fill", "rest"}));
  EXPECT_EQ(names(find_layers(picture(layers), "x.exr", "x$")), (Names{"x", "rest"}));
  EXPECT_THROW(find_layers(picture(layers), "x.exr", "("), UsageError);
  EXPECT_THROW(find_layers(picture(layers), "x.exr", "nothing"), Error);
}

TEST(LayeredImage, PicturesWithoutGroupsSaySo) {
  for (Names channels : {rgb({""}), rgb({"ViewLayer.Combined", "ViewLayer.DiffDir"}), rgb({"", "diffuse"})}) {
    channels.push_back("depth.Z");
    try {
      find_layers(picture(channels), "x.exr");
      ADD_FAILURE();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("x.exr"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("--groups-from"), std::string::npos) << e.what();
    }
  }
}

TEST(LayeredImage, GainsAndTheRest) {
  // Beauty 1 2 3, key 4 5 6, fill 7 8 9.
  const LayeredImage layered = find_layers(picture(rgb({"", "RGBA_key", "RGBA_fill"})), "x.exr");
  const auto mixed = [&](std::vector<Rgb> weights) {
    return mix_layers(layered, {std::move(weights)}).rgb_at(0, 0);
  };
  EXPECT_EQ(mixed({Rgb(1), Rgb(1), Rgb(1)}), Rgb(1, 2, 3));
  EXPECT_EQ(mixed({Rgb(1), Rgb(1), Rgb(0)}), Rgb(11, 13, 15));
  EXPECT_EQ(mixed({Rgb(0), Rgb(0), Rgb(1)}), Rgb(1 - 11, 2 - 13, 3 - 15));
  EXPECT_EQ(mixed({Rgb(2, 1, 0), Rgb(0), Rgb(0)}), Rgb(8, 5, 0));
  const Rest rest = measure_rest(layered);
  EXPECT_EQ(rest.negative, 1);
  EXPECT_LT(rest.share, 0);
  const Names lumens{"key=800lm"};
  EXPECT_THROW(make_mix(layered.groups, lumens, "", {}), UsageError);
}

TEST(LayeredImage, UnitGainsReturnEveryBit) {
  Names channels = rgb({"", "RGBA_key"});
  channels.push_back("A");
  ExrParts parts = picture(channels);
  const float bits[] = {-0.0f, 1e-42f, 3.4e38f, 0.1f, 1e-10f, 7, 0.25f};
  std::copy(std::begin(bits), std::end(bits), parts.image.data.begin());
  const LayeredImage layered = find_layers(parts, "x.exr");
  const ExrParts out = with_mixed(layered, mix_layers(layered, {{Rgb(1), Rgb(1)}}));
  EXPECT_EQ(out.image.channels, (Names{"R", "G", "B", "A"}));
  EXPECT_EQ(std::memcmp(out.image.data.data(), bits, 3 * sizeof(float)), 0);
  EXPECT_EQ(out.image.data[3], 0.25f);
}

/// Windows, integers and other channels come back from a file.
TEST(LayeredImage, TheRestOfTheFileStays) {
  Names channels = rgb({"", "RGBA_key"});
  channels.insert(channels.end(), {"Z", "id"});
  ExrParts parts = picture(channels);
  parts.image = Image(3, 2, channels);
  for (std::size_t i = 0; i < parts.image.data.size(); ++i) parts.image.data[i] = static_cast<float>(i);
  const uint32_t id = 4000000001;  // no float holds it
  std::memcpy(&parts.image.data[7], &id, sizeof id);
  parts.integer.back() = true;
  parts.data = {-2, 5, 3, 2};
  parts.display = {-3, 4, 10, 8};
  const TemporaryFolder folder;
  write_exr_parts(folder / "in.exr", parts);
  const LayeredImage layered = find_layers(read_exr_parts(folder / "in.exr"), "in.exr");
  const Image mixed = mix_layers(layered, {{Rgb(0), Rgb(1)}});
  write_exr_parts(folder / "out.exr", with_mixed(layered, mixed));
  const ExrParts out = read_exr_parts(folder / "out.exr");
  EXPECT_EQ(out.image.channels, (Names{"R", "G", "B", "Z", "id"}));
  EXPECT_EQ(out.integer, (std::vector<bool>{false, false, false, false, true}));
  EXPECT_EQ(std::memcmp(&out.image.data[4], &id, sizeof id), 0);
  EXPECT_EQ(out.image.at(1, 0)[3], parts.image.at(1, 0)[6]);
  EXPECT_EQ(out.data.x, -2);
  EXPECT_EQ(out.data.y, 5);
  EXPECT_EQ(out.display.x, -3);
  EXPECT_EQ(out.display.width, 10);
  const Image all = shown(layered, mixed);
  EXPECT_EQ(all.width, 10);
  EXPECT_EQ(all.rgb_at(0, 0), Rgb(0));
  EXPECT_EQ(all.rgb_at(1, 1), mixed.rgb_at(0, 0));
  EXPECT_EQ(all.rgb_at(3, 2), mixed.rgb_at(2, 1));
}

}  // namespace
}  // namespace sconce
