// SPDX-License-Identifier: Apache-2.0
// `bake --quality`: texels are as far from the converged bake as the words promise, and what --dry-run
// foretells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightmap_error.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

class Quality : public testing::Test {
 protected:
  test::Outcome bake(std::vector<std::string> more) const {
    more.insert(more.begin(), {"bake", scene_, "--density", "7", "--encoding", "f32"});
    const test::Outcome outcome = test::run_sconce(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  /// Pages of all groups' light together.
  static std::vector<float> lux(const Package& package) {
    std::vector<float> sum(static_cast<std::size_t>(package.manifest().width * package.manifest().height));
    for (std::size_t g = 0; g < package.manifest().groups.size(); ++g) {
      const Image layer = package.layer(g, 0);
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += luminance({layer.data[3 * i], layer.data[3 * i + 1], layer.data[3 * i + 2]});
    }
    return sum;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
  std::string scene_ = folder_.write("room.glb", write_glb(test::two_lamp_room(), "test"));
};

TEST_F(Quality, WordsAreNoise) {
  // Path tracing has no bias, so that what is left is noise. Of errors of one standard error's spread 68 %
  // are smaller than that.
  const std::vector<std::string> all{"--solver", "path", "--bounces", "2", "--quiet", "--force"};
  const auto path_bake = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), all.begin(), all.end());
    more.insert(more.end(), {"-o", path(name)});
    bake(more);
    return Package::open(path(name));
  };
  const Package reference = path_bake("reference.sconce", {"--samples", "16384", "--seed", "2"});
  const std::vector<uint8_t> inside = test::interior_texels(reference.receivers(0));
  const std::vector<float> expected = lux(reference);
  double coarser = 1;
  for (const auto& [name, noise] : {std::pair{"draft", 0.1}, {"normal", 0.03}, {"final", 0.01}}) {
    const Package package = path_bake("x.sconce", {"--quality", name});
    const std::vector<float> found = lux(package);
    std::vector<double> errors;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (inside[i] != 0 && expected[i] > 0)
        errors.push_back(std::abs(static_cast<double>(found[i] / expected[i] - 1)));
    ASSERT_GT(errors.size(), 300U);
    std::sort(errors.begin(), errors.end());
    const double usual = errors[errors.size() * 68 / 100];
    RecordProperty(name, std::to_string(usual));
    // The reference itself is off by up to a half percent.
    EXPECT_LT(usual, std::hypot(noise, 0.005)) << name;
    EXPECT_LT(usual, coarser / 2) << name << " is finer than the word before it";
    EXPECT_LT(errors[errors.size() * 98 / 100], 6 * noise) << name;
    EXPECT_NE(package.manifest().facts.at("samples").find("noise"), std::string::npos);
    coarser = usual;
  }
  EXPECT_EQ(path_bake("x.sconce", {}).manifest().options.at("quality").value, "normal");
}

// What a side file says of samples or time yields to any word of the command line on them.
TEST_F(Quality, TheCommandLineWins) {
  const auto samples = [&](const char* file, std::vector<std::string> more) {
    folder_.write("room.toml", std::string("[options]\n") + file + "\n");
    more.insert(more.end(),
                {"--solver", "path", "--bounces", "0", "--quiet", "--force", "-o", path("x.sconce")});
    bake(more);
    return Package::open(path("x.sconce")).manifest().facts.at("samples");
  };
  EXPECT_EQ(samples("samples = 16", {}), "16");
  EXPECT_EQ(samples("samples = 16", {"--quality", "draft"}), "up to 256, until 10 % noise");
  EXPECT_EQ(samples("noise = \"1%\"", {"--samples", "24"}), "24");
  EXPECT_EQ(samples("samples = 16", {"--noise", "20%"}), "up to 16384, until 20 % noise");
  EXPECT_EQ(samples("time = \"5m\"", {"--samples", "8"}), "8");
}

TEST_F(Quality, SamplesAreWhatIsAskedFor) {
  bake({"--solver", "path", "--samples", "16", "-o", path("x.sconce"), "--quiet"});
  EXPECT_EQ(Package::open(path("x.sconce")).manifest().facts.at("samples"), "16");
}

TEST_F(Quality, DryRunForetells) {
  const auto plan = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--dry-run", "--json", "-o", path("x.sconce")});
    return nlohmann::json::parse(bake(more).out);
  };
  const nlohmann::json few = plan({"--samples", "64"}), many = plan({"--samples", "512"});
  EXPECT_GT(few["receivers"], 500);
  // Two groups of three floats.
  EXPECT_EQ(few["layer_bytes"].get<double>(),
            24 * few["width"].get<double>() * few["height"].get<double>() * few["pages"].get<double>());
  // Times are of this machine as busy as it is: nothing to compare.
  EXPECT_GT(few["seconds"].get<double>(), 0);
  EXPECT_GT(many["seconds"].get<double>(), 0);
  EXPECT_EQ(many["layer_bytes"], few["layer_bytes"]);
  EXPECT_FALSE(std::filesystem::exists(path("x.sconce")));
  const std::string text = bake({"--dry-run", "-o", path("x.sconce")}).out;
  for (const char* part : {" texels", "MB", "page", "2 groups", "on this machine"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

}  // namespace
}  // namespace sconce
