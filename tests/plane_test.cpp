// SPDX-License-Identifier: Apache-2.0
// [[plane]] and `bake --probes`: baked per group, followed by `probe` in closed form and as it traces itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "package/points.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

using test::run_sconce;

class Plane : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void bake(const std::string& scene, std::vector<std::string> more) const {
    more.insert(more.begin(), {"bake", path(scene), "-o", path("x.sconce"), "--quiet"});
    const test::Outcome outcome = run_sconce(more);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  nlohmann::json probe(std::vector<std::string> more) const {
    more.insert(more.begin(), {"probe", path("x.sconce"), "--json"});
    const test::Outcome outcome = run_sconce(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
  /// A black floor, two lamps of 100 cd and 50 cd above it, each a group, and a scrap that gives the scene a
  /// height of 3 m.
  void write_floor(const std::string& more) {
    folder_.write("f.mtl", "newmtl black\nKd 0 0 0\n");
    folder_.write("f.obj",
                  "mtllib f.mtl\nusemtl black\nv -4 0 3\nv 4 0 3\nv 4 0 -3\nv -4 0 -3\nf 1 2 3 4\n"
                  "v 4 3 3\nv 3.9 3 3\nv 4 3 2.9\nf 5 6 7\n");
    folder_.write("f.toml",
                  "[[light]]\nname = \"a\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = 100\n"
                  "[[light]]\nname = \"b\"\ntype = \"point\"\nposition = [2, 1, 0]\nintensity = 50\n" +
                      more);
  }
  TemporaryFolder folder_;
};

constexpr const char* kLine =
    "[[plane]]\nname = \"line\"\ncorner = [0, 0, 0.5]\nacross = [4, 0, 0]\nalong = [0, 0, -1]\ngrid = 2\n";

// I h / d3, at 1 m and 3 m along x.
TEST_F(Plane, ClosedFormPerGroupAndFollowsFaders) {
  write_floor(kLine);
  bake("f.obj", {"--atlas", "64", "--samples", "8", "--groups", "per-light"});
  const auto a = [](double x) { return 100 * 2 / std::pow(4 + x * x, 1.5); };
  const auto b = [](double x) { return 50 / std::pow(1 + (x - 2) * (x - 2), 1.5); };
  const nlohmann::json unit = probe({"--plane", "line"});
  EXPECT_EQ(unit["points"], 2);
  EXPECT_EQ(unit["groups"][0]["name"], "a");
  EXPECT_NEAR(unit["groups"][0]["lux"]["maximum"].get<double>(), a(1), 1e-3);
  EXPECT_NEAR(unit["groups"][0]["lux"]["minimum"].get<double>(), a(3), 1e-3);
  EXPECT_NEAR(unit["groups"][1]["lux"]["average"].get<double>(), b(1), 1e-3);
  const nlohmann::json mixed = probe({"--plane", "line", "a=40%", "b=3"});
  const double near = 0.4 * a(1) + 3 * b(1), far = 0.4 * a(3) + 3 * b(3);
  EXPECT_NEAR(mixed["lux"]["maximum"].get<double>(), near, 1e-3);
  EXPECT_NEAR(mixed["lux"]["minimum"].get<double>(), far, 1e-3);
  EXPECT_NEAR(mixed["lux"]["average"].get<double>(), (near + far) / 2, 1e-3);
  EXPECT_NEAR(mixed["lux"]["uniformity"].get<double>(), far / ((near + far) / 2), 1e-4);
  EXPECT_NEAR(mixed["lux"]["diversity"].get<double>(), far / near, 1e-4);
}

TEST_F(Plane, WhatIsBakedIsWhatIsTraced) {
  write_file(folder_ / "room.glb", write_glb(test::two_lamp_room(), "test"));
  folder_.write("room.toml", "[[plane]]\nname = \"desk\"\nat = \"floor+0.9\"\ngrid = 0.4\n");
  bake("room.glb", {"--density", "6", "--samples", "8"});
  const nlohmann::json baked = probe({"--plane", "desk", "left=0.3"});
  const nlohmann::json traced =
      probe({"--plane", "floor+0.9", "--grid", "0.4", "--samples", "16384", "left=0.3"});
  EXPECT_EQ(baked["points"], traced["points"]);
  for (const char* figure : {"minimum", "average", "maximum"}) {
    const double expected = traced["lux"][figure].get<double>();
    EXPECT_NEAR(baked["lux"][figure].get<double>(), expected, 0.02 * expected) << figure;
  }
}

TEST_F(Plane, StaysWithThePackageAndFollowsTheSideFile) {
  write_floor(kLine);
  const std::vector<std::string> options{"--atlas", "64", "--samples", "8", "--groups", "per-light"};
  bake("f.obj", options);
  write_floor(std::string(kLine) + "[[plane]]\nname = \"all\"\nat = \"floor+0.5\"\n");
  bake("f.obj", options);  // solves no layer
  EXPECT_EQ(probe({"--plane", "all"})["points"], 14 * 10);
  bake("f.obj", {"--atlas", "64", "--samples", "8", "--groups", "per-light", "--probes", "2"});
  EXPECT_TRUE(read_probes(Package::open(path("x.sconce"))));
  const test::Outcome unknown = run_sconce({"probe", path("x.sconce"), "--plane", "roof"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("baked: all, line"), std::string::npos) << unknown.err;
}

// What faces a distant lamp of 1,000 lx shows 3/4 of it (docs/adr/0038-probes.md), and a group's share of
// that.
TEST_F(Plane, ProbesReadAsAnEngineDoes) {
  write_floor("[[light]]\nname = \"s\"\ntype = \"sun\"\ndirection = [0, -1, 0]\nintensity = 1000\n");
  bake("f.obj", {"--atlas", "64", "--samples", "8", "--groups", "per-light", "--probes", "1"});
  const auto lux = [&](const char* at, const char* setting) {
    return probe({"--at", at, "--probes", "a=off", "b=off", setting})["lux"]["average"].get<double>();
  };
  EXPECT_NEAR(lux("0.2,0,0.7", "s=1"), 750, 0.1);
  EXPECT_NEAR(lux("0.2,0,0.7", "s=20%"), 150, 0.1);
  EXPECT_NEAR(lux("0.2,0,0.7,1,0,0", "s=1"), 250, 0.1);
  EXPECT_NEAR(lux("0.2,0,0.7,0,-1,0", "s=1"), 0, 0.1);
}

TEST_F(Plane, BadInputIsOneLine) {
  for (const auto& [text, part] :
       {std::pair{"[[plane]]\nat = \"floor+0.5\"\n", "has no name"},
        {"[[plane]]\nname = \"x\"\n", "has no place"},
        {"[[plane]]\nname = \"x\"\nat = \"roof\"\n", "floor+0.75"},
        {"[[plane]]\nname = \"x\"\nat = \"floor+1\"\ncorner = [0, 0, 0]\n", "has no place"},
        {"[[plane]]\nname = \"x\"\nat = \"floor+1\"\nsize = 3\n", "size"},
        {"[[plane]]\nname = \"x\"\ncorner = [0,0,0]\nacross = [1,0,0]\nalong = [1,1,0]\n", "right angles"},
        {"[[plane]]\nname = \"x\"\nat = \"floor+1\"\n[[plane]]\nname = \"x\"\nat = \"floor+2\"\n",
         "taken"}}) {
    write_floor(text);
    const test::Outcome outcome = run_sconce({"bake", path("f.obj"), "--atlas", "64", "--samples", "8"});
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("f.toml:"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  write_floor("");
  const auto refused = [&](std::vector<std::string> words, int code, const char* part) {
    const test::Outcome outcome = run_sconce(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  refused({"bake", path("f.obj"), "--probes", "-1"}, 2, "out of range");
  bake("f.obj", {"--atlas", "64", "--samples", "8"});
  refused({"probe", path("x.sconce"), "--at", "0,0,0", "--probes"}, 1, "bake --probes");
}

}  // namespace
}  // namespace sconce
