// SPDX-License-Identifier: Apache-2.0
// `sconce init`: rooms from one command to lux, and side files that can be read back.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/files.h"
#include "core/test_folder.h"
#include "process.h"

namespace sconce {
namespace {

using test::run_sconce;

class Init : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  double lux(const std::string& setting) const {
    const test::Outcome probed =
        run_sconce({"probe", path("office.sconce"), "--at", "0,0.7,0", setting, "--json"});
    EXPECT_EQ(probed.code, 0) << probed.err;
    return nlohmann::json::parse(probed.out)["lux"]["average"].get<double>();
  }
  TemporaryFolder folder_;
};

TEST_F(Init, BlackRoomUnderOneLampInClosedForm) {
  // 1,000 cd down, none at 90 degrees, no opening.
  folder_.write("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n1000 0\n");
  const test::Outcome made =
      run_sconce({"init", "--room", "8x6x2.8", "--reflectance", "0/0/0", "--luminaire", path("lamp.ies"),
                  "--mount", "2.7", "-o", path("office.glb"), "--force"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("next: sconce bake"), std::string::npos);
  const test::Outcome baked =
      run_sconce({"bake", path("office.glb"), "--atlas", "128", "--samples", "8", "--quiet"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  EXPECT_NEAR(lux("luminaires=on"), 1000 / 4.0, 0.5);
  EXPECT_NEAR(lux("luminaires=40%"), 400 / 4.0, 0.2);
}

TEST_F(Init, SideFileOfASceneSaysWhatIsSoAlready) {
  const std::string scene = std::string(SCONCE_SOURCE_DIR) + "/scenes/bathroom.glb";
  std::filesystem::copy_file(scene, path("bath.glb"));
  const test::Outcome before = run_sconce({"info", path("bath.glb"), "--json"});
  ASSERT_EQ(run_sconce({"init", path("bath.glb")}).code, 0);
  const std::string side = read_file(path("bath.toml"));
  for (const char* part : {"# mirror: 2 lamps, 1200 lm", "\"downlight 4\"", "# Cameras: main"})
    EXPECT_NE(side.find(part), std::string::npos) << side;
  const test::Outcome after = run_sconce({"info", path("bath.glb"), "--json"});
  EXPECT_EQ(before.out, after.out);
  // Uncommented, its groups are those that are.
  std::string groups;
  std::istringstream lines(side);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("# [group") || line.starts_with("# nodes")) groups += line.substr(2) + "\n";
  write_file(path("bath.toml"), groups);
  EXPECT_EQ(run_sconce({"info", path("bath.glb"), "--json"}).out, before.out);
}

TEST_F(Init, WhatIsSuspiciousIsNamed) {
  folder_.write("x.mtl", "newmtl snow\nKd 0.95 0.95 0.95\n");
  folder_.write("x.obj", "mtllib x.mtl\nusemtl snow\nv 0 0 0\nv 500 0 0\nv 0 0 500\nf 1 3 2\n");
  ASSERT_EQ(run_sconce({"init", path("x.obj")}).code, 0);
  const std::string side = read_file(path("x.toml"));
  for (const char* part : {"unit = \"cm\"", "Material \"snow\" reflects 95 %", "The scene has no camera"})
    EXPECT_NE(side.find(part), std::string::npos) << side;
}

TEST_F(Init, NothingIsWrittenOverAndBadInputIsOneLine) {
  ASSERT_EQ(run_sconce({"init", "--room", "3x3x2.5", "-o", path("r.glb")}).code, 0);
  const test::Outcome again = run_sconce({"init", "--room", "4x4x2.5", "-o", path("r.glb")});
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.err.find("--force"), std::string::npos);
  EXPECT_NE(read_file(path("r.toml")).find("3 x 3 x 2.5"), std::string::npos);
  EXPECT_EQ(run_sconce({"init"}).code, 2);
  EXPECT_EQ(run_sconce({"init", "--room", "3x3"}).code, 2);
  EXPECT_EQ(run_sconce({"init", "--room", "3x3x2", "--reflectance", "70/50/200", "-o", path("s.glb")}).code,
            2);
  EXPECT_EQ(run_sconce({"init", "--room", "3x3x2", "--mount", "5", "-o", path("s.glb")}).code, 2);
  folder_.write("bad.ies", "no lamp");
  EXPECT_EQ(run_sconce({"init", "--room", "3x3x2", "--luminaire", path("bad.ies"), "-o", path("s.glb")}).code,
            1);
  EXPECT_FALSE(std::filesystem::exists(path("s.glb")));
}

}  // namespace
}  // namespace sconce
