// SPDX-License-Identifier: Apache-2.0
// Blender's files: our picture of what is exported against Cycles' picture of the same file, and the add-on.
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "blender.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/primaries.h"
#include "import/import.h"
#include "process.h"
#include "scene/groups.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

class Blend : public test::BlenderTest {
 protected:
  TemporaryFolder folder;

  std::string path(const std::string& name) const { return (folder / name).string(); }
  /// blend_room.py with these arguments.
  void blender(const std::string& arguments) const {
    const std::string command = "BLENDER_USER_SCRIPTS='" + path("scripts") + "' " + test::blender() +
                                " -b --factory-startup --python-exit-code 1 -P " SCONCE_SOURCE_DIR
                                "/tests/blend_room.py -- " +
                                arguments + " >'" + path("log") + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << read_file(path("log"));
  }
};

class BlendLamps : public Blend, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BlendLamps,
                         testing::Values("square", "ellipse", "point", "spot", "sun", "world"),
                         [](const auto& kind) { return std::string(kind.param); });

// Diffuse materials: the means agree within 2 %, and so does the picture but for noise and edges of shadows.
TEST_P(BlendLamps, AsBrightAsCyclesPicture) {
  const std::string kind = GetParam();
  blender("render '" + path("") + "' " + kind);
  const test::Outcome bake =
      test::run_sconce({"bake", path(kind + ".blend"), "-o", path("p.sconce"), "--solver", "path",
                        "--density", "16", "--samples", "256", "--quiet"});
  ASSERT_EQ(bake.code, 0) << bake.err;
  const test::Outcome render =
      test::run_sconce({"render", path("p.sconce"), "--camera", "camera", "--size", "160x120", "--tone",
                        "linear", "-o", path("ours.exr"), "--quiet"});
  ASSERT_EQ(render.code, 0) << render.err;
  Image cycles = rgb_part(read_image(path(kind + ".exr")), kind);
  for (float& v : cycles.data) v *= 683;  // lumens per watt
  const RelativeRmse error =
      relative_rmse(rgb_part(read_image(path("ours.exr")), kind), cycles, nullptr, nullptr);
  EXPECT_NEAR(error.mean_ratio, 1, 0.02);
  EXPECT_LT(error.rmse, kind == "spot" ? 0.2 : 0.1) << "glTF's cone has another edge than Blender's";
  RecordProperty("mean_ratio", std::to_string(error.mean_ratio));
  RecordProperty("rmse", std::to_string(error.rmse));
}

TEST_F(Blend, AddOnBakesAndGivesTheMixBack) {
  blender("operators '" + path("") + "' " SCONCE_SOURCE_DIR "/src/import/sconce_blender.py " SCONCE_PROGRAM);
  const auto report = nlohmann::json::parse(read_file(path("operators.json")));
  for (const auto& result : report.at("results")) EXPECT_EQ(result.at(0), "FINISHED");
  // Half of 60 W; twice applied is once applied.
  const std::vector<double> key = report.at("lamps").at("key");
  EXPECT_NEAR(key[0], 30, 1e-3);
  EXPECT_NEAR(key[2], 18, 1e-3);
  EXPECT_EQ(report.at("lamps").at("sconce").at(0), 0);
  EXPECT_TRUE(fs::exists(path("groups.sconce/manifest.json")));

  Scene scene = import_scene(path("groups.blend"));
  assign_groups(scene, Grouping::named);
  std::vector<std::string> groups;
  for (const LightGroup& group : scene.groups) groups.push_back(group.name);
  EXPECT_EQ(groups, (std::vector<std::string>{"desk", "wall lamps"}));
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_NEAR(scene.cameras[0].frame[3].y, 2.2f, 1e-5f) << "Blender's z is up";
  const auto pane = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& m) { return m.name == "pane"; });
  ASSERT_NE(pane, scene.materials.end());
  EXPECT_EQ(pane->transmission, 1) << "light goes through glass";
}

TEST(BlendWithout, BlenderIsOneClearLine) {
  const TemporaryFolder folder;
  const std::string file = folder.write("room.blend", "BLENDER-v304");
  ::setenv("BLENDER", "/nonexistent/blender", 1);
  try {
    import_scene(file);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/blender"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  ::unsetenv("BLENDER");
}

}  // namespace
}  // namespace sconce
