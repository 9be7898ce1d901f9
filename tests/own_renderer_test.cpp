// SPDX-License-Identifier: Apache-2.0
// The verb `shader` and the example host, on packages of every encoding.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/files.h"
#include "package/test_package.h"
#include "process.h"
#include "tone/apply.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

class ShaderVerb : public testing::Test {
 protected:
  ShaderVerb() {
    PackageContents c = test_package(7, 1, 24, 24);
    c.encodings = {"f16", "lum:f16", "exp8", "rgbe8", "multi8", "bc6h", "lum:f16"};
    for (GroupInfo& group : c.manifest.groups) group.mean_lux = 10;
    write_package(package, c);
  }
  test::Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"shader", package.string()});
    return test::run_sconce(arguments);
  }

  TemporaryFolder folder;
  fs::path package = folder / "x.sconce";
};

TEST_F(ShaderVerb, DescribesWhatItWants) {
  const std::string file = (folder / "x.glsl").string();
  ASSERT_EQ(run({"-o", file, "--target", "glsl330"}).code, 0);
  EXPECT_EQ(read_file(file).find("#version 330 core"), 0u);
  const auto json = nlohmann::json::parse(read_file(file + ".json"));
  ASSERT_EQ(json["samplers"].size(), 7u);  // two luminances share, multi8 has two planes
  for (const auto& sampler : json["samplers"]) {
    EXPECT_NE(read_file(file).find(sampler["name"].get<std::string>()), std::string::npos);
    EXPECT_TRUE(fs::exists(package / sampler["pages"][0]["file"].get<std::string>()));
  }
  EXPECT_EQ(json["uniforms"]["sconce_weight"]["of"].size(), 7u);
  EXPECT_NE(json["convention"].get<std::string>().find("TEXCOORD_1"), std::string::npos);
}

TEST_F(ShaderVerb, FormsAndMistakes) {
  const test::Outcome functions = run({"-o", "-", "--form", "functions"});
  EXPECT_EQ(functions.code, 0);
  EXPECT_EQ(functions.out.find("#version"), std::string::npos);
  EXPECT_EQ(run({"-o", "-", "--target", "hlsl"}).code, 2);
  EXPECT_EQ(run({"-o", "-", "--tier", "none"}).code, 2);
  EXPECT_EQ(run({"-o", "-", "--form", "compute", "--target", "glsl330"}).code, 1);
}

/// What the example draws is the layers' sum through the same curve.
TEST_F(ShaderVerb, TheExampleDraws) {
  const std::string out = (folder / "x.ppm").string();
  const test::Outcome outcome = test::run_program(HOST_GL, {package.string(), out, "b=0.5", "c=2", "g=off"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string picture = read_file(out), head = "P6 512 512 255\n";
  ASSERT_EQ(picture.substr(0, head.size()), head);
  const Package opened = Package::open(package);
  const float weights[] = {1, 0.5f, 2, 1, 1, 1, 0};
  Rgb sum;
  float mean = 0;
  for (std::size_t g = 0; g < 7; ++g) {
    sum += weights[g] * opened.layer(g, 0).rgb_at(12, 12);
    mean += weights[g] * 10;
  }
  const Rgb expected =
      tone_map(sum * kInvPi, {kMiddleGrey * 3.14159265f / mean, {}}, find_tone_mapper("agx"));
  // The centre of texel (12, 12) of 24, in 512 pixels.
  const std::size_t at = head.size() + 3 * (266 * 512 + 266);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(static_cast<unsigned char>(picture[at + k]),
                255 * (k == 0   ? expected.r
                       : k == 1 ? expected.g
                                : expected.b),
                2.5);
}

}  // namespace
}  // namespace sconce
