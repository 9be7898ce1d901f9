// SPDX-License-Identifier: Apache-2.0
#include "package/manifest.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "package/test_package.h"

namespace sconce {
namespace {

Manifest sample() {
  Manifest m = test_package(2, 2, 8, 4).manifest;
  m.groups[0].color = {1.9f, 0.8f, 0.1f};
  m.groups[1].infinite = true;
  m.groups[1].noise = 0.03125;
  for (uint32_t g = 0; g < 2; ++g)
    for (int p = 0; p < 2; ++p)
      m.layers.push_back({g, p, "f16", page_file(g == 0 ? "a" : "b", p), "00ff", 12});
  m.hashes["scene.glb"] = "abc";
  m.instance_twins = {-1, 0};
  m.instance_pages = {0, 1};
  return m;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    parse_manifest(text, "x.sconce/manifest.json");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(Manifest, EveryFieldComesBack) {
  const Manifest a = sample(), b = parse_manifest(print_manifest(a), "m");
  EXPECT_EQ(print_manifest(a), print_manifest(b));
  EXPECT_EQ(b.generator, a.generator);
  EXPECT_EQ(b.scene_name, "quad");
  EXPECT_EQ(b.width, 8);
  EXPECT_EQ(b.pages, 2);
  EXPECT_EQ(b.lightmap_set, 1u);
  EXPECT_EQ(b.instance_twins, a.instance_twins);
  EXPECT_EQ(b.groups[0].color, a.groups[0].color);
  EXPECT_TRUE(b.groups[1].infinite);
  EXPECT_EQ(b.groups[1].noise, 0.03125);
  EXPECT_EQ(b.groups[1].lamps, a.groups[1].lamps);
  ASSERT_EQ(b.layers.size(), 4u);
  EXPECT_EQ(b.layers[3].group, 1u);
  EXPECT_EQ(b.layers[3].file, "b.1.exr");
  EXPECT_EQ(b.layers[3].bytes, 12u);
  EXPECT_EQ(b.hashes, a.hashes);
  EXPECT_EQ(b.options.at("seed").source, "default");
  EXPECT_EQ(b.facts.at("solver"), "none");
}

TEST(Manifest, OtherVersionNamesBoth) {
  const std::string error = error_of(replaced(print_manifest(sample()), "\"version\": 1", "\"version\": 7"));
  EXPECT_NE(error.find("version 7"), std::string::npos) << error;
  EXPECT_NE(error.find("version 1"), std::string::npos) << error;
  EXPECT_NE(error.find("manifest.json"), std::string::npos) << error;
}

TEST(Manifest, ForeignJsonIsNotMine) {
  EXPECT_THROW(parse_manifest("{\"name\": \"web app\"}", "m"), NotMyFormat);
  EXPECT_THROW(parse_manifest("[]", "m"), NotMyFormat);
}

TEST(Manifest, TruncatedAnywhereIsOneError) {
  const std::string text = print_manifest(sample());
  for (std::size_t n = 0; n + 2 < text.size(); n += 7)
    EXPECT_THROW(parse_manifest(text.substr(0, n), "m"), Error) << n;
}

TEST(Manifest, MissingOrMistypedKeyIsNamed) {
  const std::string text = print_manifest(sample());
  const struct {
    const char *from, *to, *key;
  } cases[] = {
      {"\"lumens\"", "\"lumen\"", "groups[0].lumens is missing"},
      {"\"lumens\": 100.0", "\"lumens\": \"100\"", "groups[0].lumens is no number"},
      {"\"infinite\": false", "\"infinite\": 0", "groups[0].infinite"},
      {"\"width\": 8", "\"width\": 0", "atlas.width"},
      {"\"width\": 8", "\"width\": 8.5", "atlas.width"},
      {"\"width\": 8", "\"width\": 1e300", "atlas.width"},
      {"\"width\": 8", "\"width\": 18446744073709551615", "atlas.width"},
      {"\"instance_twins\": [-1,0]", "\"instance_twins\": [-1]", "atlas.instance_twins"},
      {"\"instance_twins\": [-1,0]", "\"instance_twins\": [-1,2]", "atlas.instance_twins[1]"},
      {"\"instance_pages\": [0,1]", "\"instance_pages\": [0,2]", "atlas.instance_pages[1]"},
      {"\"page\": 1", "\"page\": 2", "layers[1].page"},
      {"\"page\": 1", "\"page\": 0", "layers has more than one page 0 of group 'a'"},
      {"\"group\": \"a\"", "\"group\": \"z\"", "layers[0].group"},
      {"\"file\": \"a.0.exr\"", "\"file\": \"../a.0.exr\"", "layers[0].file"},
      {"\"file\": \"a.0.exr\"", "\"file\": \"..\"", "layers[0].file"},
      {"\"file\": \"a.0.exr\"", "\"file\": \"\"", "layers[0].file"},
      {"\"scene.glb\"", "\"/etc/passwd\"", "files"},
      {"\"options\"", "\"option\"", "options is missing"},
  };
  for (const auto& c : cases) {
    const std::string error = error_of(replaced(text, c.from, c.to));
    EXPECT_NE(error.find(c.key), std::string::npos) << c.to << " gives: " << error;
    EXPECT_EQ(error.find("x.sconce/manifest.json: "), 0u) << error;
  }
}

TEST(Manifest, NumbersMustBeFinite) {
  Manifest m = sample();
  m.groups[1].mean_lux = std::numeric_limits<double>::infinity();
  EXPECT_THROW(print_manifest(m), Error);
}

TEST(Manifest, LayerNamesSuitOpenExrAndStayApart) {
  std::vector<GroupInfo> groups(4);
  groups[0].name = "lamp.1";
  groups[1].name = "lamp_1";
  groups[2].name = "L\xc3\xa4mp";
  groups[3].name = "";
  EXPECT_EQ(layer_names(groups), (std::vector<std::string>{"lamp_1", "lamp_1_2", "L__mp", "_"}));
}

TEST(Manifest, BaseNames) {
  for (const char* good : {"a.exr", "a-b_1", "a b"}) EXPECT_TRUE(is_base_name(good)) << good;
  for (const char* bad : {"", ".", "..", ".a", "a/b", "/a", "a\\b"}) EXPECT_FALSE(is_base_name(bad)) << bad;
}

}  // namespace
}  // namespace sconce
