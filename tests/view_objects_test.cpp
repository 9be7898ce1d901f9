// SPDX-License-Identifier: Apache-2.0
// Objects moved in the window: shadows follow at once, bounces when the operator has.
#include <fmt/format.h>

#include "core/test_data.h"
#include "view_window.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

const Vec3 kThere = test::kBlock + Vec3(-0.9f, 0, 0.2f);

class ViewObjects : public ViewTest {
 protected:
  void bake_room(const std::string& name, const Scene& scene) {
    write_file(folder_ / (name + ".glb"), write_glb(scene, "test"));
    const auto made =
        test::run_sconce({"bake", path(name + ".glb"), "--density", "24", "--samples", "128", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
};

// The block is dragged by a hand and turned by a key; what is shown at rest is the scene baked with the block
// there. Before its bounces have followed the window says so.
TEST_F(ViewObjects, AnObjectIsPutElsewhereAndItsLightFollows) {
  bake_room("x", test::two_lamp_room());
  bake_room("there", test::with_block_at(kThere, 30));
  const std::string place = fmt::format("{},{},{}", kThere.x, kThere.y, kThere.z);
  const auto outcome =
      view("ev100 3\nset right=0.5\nsettle\npicture " + path("home.png") + "\nobject block " + place +
           ",15\nkey r\nframes 3\nobjects " + path("early.txt") + "\nscreenshot " + path("early-all.png") +
           "\nsettle\npicture " + path("there.png") + "\nscreenshot " + path("all.png") + "\nobjects " +
           path("objects.txt") + "\ntug x 40,0\nsettle\nobjects " + path("tugged.txt") +
           "\nkey ctrl+z\nsettle\npicture " + path("undone.png") + "\nhome\nsettle\npicture " +
           path("back.png") + "\npick blok\n");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("no object 'blok'"), std::string::npos) << outcome.err;
  const Image8 there = png("there.png");
  const auto rendered = test::run_sconce(
      {"render", path("there.sconce"), "right=0.5", "--ev100", "3", "--device", "cpu", "--size",
       std::to_string(there.width) + "x" + std::to_string(there.height), "-o", path("truth.png")});
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_LE(mean_difference(there, png("truth.png")), 2);
  EXPECT_GT(mean_difference(png("home.png"), png("truth.png")), 4);
  EXPECT_LE(mean_difference(png("undone.png"), there), 0.1);
  EXPECT_LE(mean_difference(png("back.png"), png("home.png")), 0.01);

  const std::string early = read_file(path("early.txt")), now = read_file(path("objects.txt")),
                    tugged = read_file(path("tugged.txt"));
  if (!early.empty()) {
    EXPECT_NE(early.find("# bounces are those of other places"), std::string::npos) << early;
  }
  std::size_t slots = 0, all = 0, texels = 0, all_texels = 0;
  float x = 0, y = 0, z = 0, turn = 0;
  ASSERT_EQ(std::sscanf(now.c_str(),
                        "block=%f,%f,%f,%f\n# bounces: %zu of %zu rows of the cloud, %zu of %zu of texels",
                        &x, &y, &z, &turn, &slots, &all, &texels, &all_texels),
            8)
      << now;
  EXPECT_NEAR(x, kThere.x, 1e-3);
  EXPECT_NEAR(turn, 30, 1e-3);
  EXPECT_LT(slots, all);
  EXPECT_GT(slots, 0u);
  EXPECT_LE(texels, all_texels);
  float tugged_x = 0;
  ASSERT_EQ(std::sscanf(tugged.c_str(), "block=%f,", &tugged_x), 1) << tugged;
  EXPECT_GT(tugged_x, x + 0.05f);
}

// Opened by the window while it is baked; normals show that the box went, whatever its light.
TEST_F(ViewObjects, BoxesOfA3dsFileMove) {
  fs::copy_file(test_data() / "conformance/assimp-3ds/test1.3ds", folder_ / "boxes.3ds");
  const auto outcome =
      view("eye 20,15,25 0,0,-5\nlook normals\nframes 2\npicture " + path("before.png") +
               "\nobject Box01 3,0,-2\nframes 2\nobjects " + path("objects.txt") + "\nframes 2\npicture " +
               path("after.png") + "\nscreenshot " + path("all.png") + "\n",
           "boxes.3ds");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(read_file(path("objects.txt")).starts_with("Box01=3.0000,0.0000,-2.0000\n"));
  EXPECT_GT(mean_difference(png("before.png"), png("after.png")), 0.5);
}

}  // namespace
}  // namespace sconce
