// SPDX-License-Identifier: Apache-2.0
// `sconce probe`: lux in closed form, per group and mixed, and what it writes.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/files.h"
#include "core/test_folder.h"
#include "image/io.h"
#include "process.h"

namespace sconce {
namespace {

/// A black floor of 8 m x 6 m under an overcast sky and a lamp of 100 cd, 2 m up.
class Probe : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("x.mtl", "newmtl black\nKd 0 0 0\n");
    folder_.write("x.obj", "mtllib x.mtl\nusemtl black\nv -4 0 3\nv 4 0 3\nv 4 0 -3\nv -4 0 -3\nf 1 2 3 4\n");
    folder_.write("x.toml",
                  "[sky]\nkind = \"cie-overcast\"\n[[light]]\nname = \"lamp\"\ntype = \"point\"\n"
                  "position = [0, 2, 0]\nintensity = 100\n");
    const test::Outcome baked = test::run_sconce(
        {"bake", path("x.obj"), "-o", path("x.sconce"), "--atlas", "64", "--samples", "8", "--quiet"});
    ASSERT_EQ(baked.code, 0) << baked.err;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  nlohmann::json probe(std::vector<std::string> more) const {
    std::vector<std::string> all{"probe", path("x.sconce"), "--json", "--samples", "4096"};
    all.insert(all.end(), more.begin(), more.end());
    const test::Outcome outcome = test::run_sconce(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
  TemporaryFolder folder_;
};

TEST_F(Probe, ClosedFormsPerGroupAndMixed) {
  const nlohmann::json dark = probe({"--at", "0,0.5,0", "sky=off"});
  EXPECT_NEAR(dark["lux"]["average"].get<double>(), 100 / 2.25, 0.01);  // cd / m2
  const nlohmann::json tilted = probe({"--at", "1.5,0.5,0,-1,0,0", "sky=off"});
  EXPECT_NEAR(tilted["lux"]["average"].get<double>(), 100 / 4.5 * std::sqrt(0.5), 0.01);
  EXPECT_NEAR(probe({"--at", "0,0.5,0", "sky=off", "lamp=40%"})["lux"]["average"].get<double>(), 40 / 2.25,
              0.01);
  const nlohmann::json day = probe({"--at", "0,0.5,0", "lamp=off"});
  EXPECT_NEAR(day["lux"]["average"].get<double>(), 10000, 20);  // unobstructed
  EXPECT_NEAR(day["daylight_factor_percent"]["average"].get<double>(), 100, 0.2);
  const nlohmann::json kept = probe({"--at", "0,0.5,0", "--maintenance", "0.8"});
  EXPECT_NEAR(kept["lux"]["average"].get<double>(), 0.8 * (10000 + 100 / 2.25), 20);
  EXPECT_NEAR(kept["daylight_factor_percent"]["average"].get<double>(), 100, 0.2);
}

// What `relight` takes: the lamp elsewhere, turned, another one, one more.
TEST_F(Probe, ClosedFormsOfLampsElsewhere) {
  const auto lux = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--at", "0,0.5,0", "sky=off"});
    return probe(std::move(more))["lux"]["average"].get<double>();
  };
  EXPECT_NEAR(lux({"--move", "lamp=1,3,0"}), 100 * 2.5 / std::pow(1 + 2.5 * 2.5, 1.5), 0.01);
  EXPECT_NEAR(lux({"--kind", "lamp=point,intensity=50", "lamp=40%"}), 20 / 2.25, 0.01);
  EXPECT_NEAR(lux({"--kind", "lamp=spot,outer=20,intensity=50", "--move", "lamp=0,2,1"}), 0, 1e-6);
  EXPECT_NEAR(
      lux({"--kind", "lamp=spot,outer=20,inner=19,intensity=50", "--move", "lamp=0,2.5,1.5,target=0,0.5,0"}),
      50 / 6.25 * 0.8, 0.01);
  folder_.write("moved.toml", "[mix]\nlamp = 0.5\n[lamp.lamp]\nat = [0, 1, 0]\n");
  EXPECT_NEAR(lux({"--preset", path("moved.toml")}), 50 / 0.25, 0.01);
  const nlohmann::json more =
      probe({"--light", "point,position=0,1,0,intensity=30", "--at", "0,0.5,0", "sky=off"});
  EXPECT_NEAR(more["lux"]["average"].get<double>(), 30 / 0.25 + 100 / 2.25, 0.01);
  ASSERT_EQ(more["groups"].size(), 3u);
  EXPECT_EQ(more["groups"][2]["name"], "added");
  EXPECT_NEAR(more["groups"][2]["lux"]["average"].get<double>(), 30 / 0.25, 0.01);
}

// Faders are sought with lamps where they are, and the preset keeps them there. A lamp beside the groups
// gives 40 lx below it whatever they are, so that the group's lamp, 1 m up, goes to 60 cd for 100 lx. 3 m
// aside both give what only they explain, not the even sky.
TEST_F(Probe, FitSeeksWithLampsElsewhere) {
  const double aside = 60 / std::pow(10, 1.5) + 10 * 0.5 / std::pow(9.25, 1.5);
  const std::string light = "point,position=0,1,0,intensity=10";
  const test::Outcome fitted = test::run_sconce({"fit", path("x.sconce"), "--lux", "0,0.5,0=100", "--lux",
                                                 "3,0.5,0=" + std::to_string(aside), "--move", "lamp=0,1.5,0",
                                                 "--light", light, "-o", path("fit.toml"), "--json"});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const nlohmann::json report = nlohmann::json::parse(fitted.out);
  EXPECT_NEAR(report["points"][0]["lux"].get<double>(), 100, 0.5);
  EXPECT_NEAR(report["points"][1]["lux"].get<double>(), aside, 0.02);
  const nlohmann::json reached =
      probe({"--at", "0,0.5,0", "--preset", path("fit.toml"), "--light", light, "sky=off"});
  EXPECT_NEAR(reached["groups"][0]["lux"]["average"].get<double>(), 60, 0.5);
  EXPECT_NEAR(reached["groups"][2]["lux"]["average"].get<double>(), 40, 0.01);
}

TEST_F(Probe, PlanesAndTheirStatistics) {
  // Two points at 1 m and 3 m beside the lamp's foot.
  const nlohmann::json two = probe({"--plane", "0,0,-0.5/4,0,0/0,0,1", "--grid", "2", "sky=off"});
  EXPECT_EQ(two["points"], 2);
  const auto lux = [](double x) { return 100 * 2 / std::pow(4 + x * x, 1.5); };
  EXPECT_NEAR(two["lux"]["maximum"].get<double>(), 0, 1e-6);  // faces down: A x B
  const nlohmann::json up = probe({"--plane", "0,0,0.5/4,0,0/0,0,-1", "--grid", "2", "sky=off"});
  EXPECT_NEAR(up["lux"]["maximum"].get<double>(), lux(1), 0.01);
  EXPECT_NEAR(up["lux"]["minimum"].get<double>(), lux(3), 0.01);
  EXPECT_NEAR(up["lux"]["uniformity"].get<double>(), lux(3) / ((lux(1) + lux(3)) / 2), 1e-3);

  const test::Outcome outcome = test::run_sconce({"probe", path("x.sconce"), "--plane", "floor+0.75",
                                                  "--grid", "1", "--samples", "64", "-o", path("p.csv")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream csv(read_file(path("p.csv")));
  std::string head, line;
  std::getline(csv, head);
  EXPECT_EQ(head, "x,y,z,nx,ny,nz,lux,daylight_factor_percent,\"lux lamp\",\"lux sky\"");
  int lines = 0;
  while (std::getline(csv, line)) ++lines;
  EXPECT_EQ(lines, 7 * 5);
}

TEST_F(Probe, LinesAsRtraceHasThem) {
  folder_.write("points.txt", "# by hand\n0 0.5 0 0 1 0\n\n1.5 0.5 0 -1 0 0\n");
  const test::Outcome outcome = test::run_sconce({"probe", path("x.sconce"), "--points", "-", "sky=off"},
                                                 "cat " + path("points.txt") + " |");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream out(outcome.out);
  double r = 0, g = 0, b = 0;
  ASSERT_TRUE(out >> r >> g >> b);
  EXPECT_NEAR(g, 100 / 2.25, 0.01);
  ASSERT_TRUE(out >> r >> g >> b);
  EXPECT_NEAR(b, 100 / 4.5 * std::sqrt(0.5), 0.01);
}

TEST_F(Probe, PageAndPicture) {
  for (const char* name : {"p.html", "p.png"}) {
    const test::Outcome outcome =
        test::run_sconce({"probe", path("x.sconce"), "--plane", "floor+0.75", "--samples", "64", "sky=off",
                          "--maintenance", "0.7", "-o", path(name)});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const std::string page = read_file(path("p.html"));
  for (const char* part : {"maintenance factor</td><td>0.70", "sky=off", "data:image/png;base64,", "U0"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  const Image picture = read_image(path("p.png"));
  EXPECT_GT(picture.width, 640);
  // The middle is brighter than the corner: red over blue.
  EXPECT_NE(picture.rgb_at(336, 240), picture.rgb_at(20, 20));
}

TEST_F(Probe, BadInputIsOneLine) {
  const auto refused = [&](std::vector<std::string> more, int code, const char* part) {
    std::vector<std::string> all{"probe", path("x.sconce")};
    all.insert(all.end(), more.begin(), more.end());
    const test::Outcome outcome = test::run_sconce(all);
    EXPECT_EQ(outcome.code, code) << part;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused({}, 2, "no points");
  refused({"--at", "1,2"}, 2, "'1,2' is no point");
  refused({"--plane", "roof"}, 2, "floor+HEIGHT");
  refused({"--plane", "0,0,0/1,0,0/1,1,0"}, 2, "right angles");
  refused({"--at", "0,0,0", "-o", path("p.png")}, 2, "needs --plane");
  refused({"--at", "0,0,0", "--maintenance", "2"}, 2, "out of range");
  refused({"--at", "0,0,0", "--move", "lmp=1,1,1"}, 2, "did you mean 'lamp'");
  refused({"--at", "0,0,0", "--object", "chair=1,1,1"}, 2, "no object 'chair'");
  refused({"--at", "0,0,0", "--probes", "--move", "lamp=1,1,1"}, 2, "probes know lamps");
  folder_.write("bad.txt", "0 1 2\n3 4 x\n");
  refused({"--points", path("bad.txt")}, 1, "bad.txt:2");
}

}  // namespace
}  // namespace sconce
