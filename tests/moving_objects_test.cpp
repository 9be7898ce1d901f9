// SPDX-License-Identifier: Apache-2.0
// Things that move: the example's viewer, and objects of packages put elsewhere.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/files.h"
#include "image/io.h"
#include "process.h"
#include "relit_room.h"

namespace sconce {
namespace {

/// Six quads. @param base  vertices before it
std::string box(float lo, float hi, bool inward, int base) {
  std::string out;
  for (int k = 0; k < 8; ++k) {
    out += "v";
    for (int axis = 0; axis < 3; ++axis) out += " " + std::to_string((k >> axis & 1) != 0 ? hi : lo);
    out += "\n";
  }
  const std::array<std::array<int, 4>, 6> faces{
      {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}};
  for (const auto& face : faces) {
    out += "f";
    for (std::size_t k = 0; k < 4; ++k) out += " " + std::to_string(base + face[inward ? 3 - k : k]);
    out += "\n";
  }
  return out;
}

TEST(MovingObjects, PicturesSayWhenBouncesAreOld) {
  const TemporaryFolder folder;
  const std::string scene = (folder / "room.obj").string(), out = (folder / "out").string();
  write_file(folder / "room.mtl", "newmtl white\nKd 0.7 0.7 0.7\nnewmtl red\nKd 0.7 0.1 0.1\n");
  write_file(folder / "room.obj", "mtllib room.mtl\no room\nusemtl white\n" + box(0, 4, true, 0) +
                                      "o crate\nusemtl red\n" + box(0.5f, 1.5f, false, 8));
  const test::Outcome outcome = test::run_program(MOVING, {scene, "crate", out, "4"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto bar = [&](const char* number) {
    const Image picture = read_image(out + "-" + number + ".png");
    const Rgb top = picture.rgb_at(picture.width / 2, 0);
    return top.r > 2 * top.g;
  };
  EXPECT_FALSE(bar("00"));
  EXPECT_TRUE(bar("01"));   // the crate has just moved
  EXPECT_FALSE(bar("03"));  // waited for
  EXPECT_NE(outcome.out.find(", of the object's old place\n"), std::string::npos) << outcome.out;

  const test::Outcome unknown = test::run_program(MOVING, {scene, "piano", out});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.err.find("piano"), std::string::npos) << unknown.err;
}

/// A floor and a ceiling lamp's room with its block at two places, baked for each.
class PutElsewhere : public testing::Test {
 protected:
  static inline const Vec3 kThere = test::kBlock + Vec3(-0.9f, 0, 0.2f);
  static constexpr float kTurn = 30;  // degrees
  TemporaryFolder folder;
  std::string file(const std::string& name) const { return (folder / name).string(); }

  void bake(const std::string& name, const Scene& scene) {
    write_file(folder / (name + ".glb"), write_glb(scene, "test"));
    const test::Outcome made =
        test::run_sconce({"bake", file(name + ".glb"), "--density", "24", "--samples", "256", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  test::Outcome picture(std::vector<std::string> words, const std::string& output) const {
    for (const char* word : {"--size", "160x120", "--device", "cpu", "-o"}) words.emplace_back(word);
    words.push_back(file(output));
    return test::run_sconce(words);
  }
};

// Lux where the block was and in its new shadow, with a lamp moved, too: the paths of a scene that is so.
TEST_F(PutElsewhere, LuxIsThatOfTheSceneSetUpAnew) {
  Scene there = test::with_block_at(kThere, kTurn);
  for (Instance& instance : there.instances)
    if (instance.name == "lamp left") instance.transform[3] += glm::vec4(0.6f, -0.58f, 0.2f, 0);
  for (const auto& [name, scene] : {std::pair{"here", test::two_lamp_room()}, {"there", there}}) {
    write_file(folder / (std::string(name) + ".glb"), write_glb(scene, "test"));
    const test::Outcome made = test::run_sconce(
        {"bake", file(std::string(name) + ".glb"), "--density", "4", "--samples", "1", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  const auto lux = [&](const std::string& package, const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "probe", file(package), "right=0.5",       "--json", "--samples",
        "8192",  "--at",        "0.35,0.01,-0.35", "--at",   "-0.9,0.3,-0.2,-1,0,0"};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome probed = test::run_sconce(words);
    EXPECT_EQ(probed.code, 0) << probed.err;
    return nlohmann::json::parse(probed.out)["lux"];
  };
  const auto moved =
                 lux("here.sconce", {"--move", "lamp left=0,1.4,0.2", "--object",
                                     fmt::format("block={},{},{},{}", kThere.x, kThere.y, kThere.z, kTurn)}),
             made = lux("there.sconce", {}), home = lux("here.sconce", {});
  for (const char* figure : {"minimum", "maximum"}) {
    const double truth = made[figure].get<double>();
    EXPECT_NEAR(moved[figure].get<double>(), truth, 0.01 * truth) << figure;
    EXPECT_GT(std::abs(home[figure].get<double>() - truth), 0.05 * truth) << figure;
  }
}

// The picture is that of the scene baked anew with the block there; the floor that it left is lit, too.
TEST_F(PutElsewhere, PicturesAreThoseOfTheSceneBakedThere) {
  bake("here", test::two_lamp_room());
  bake("there", test::with_block_at(kThere, kTurn));
  const std::string middle = fmt::format("{},{},{},{}", kThere.x, kThere.y, kThere.z, kTurn);
  for (const std::string mix : {"right=on", "left=0.5"}) {
    for (const auto& [words, output] :
         {std::pair{std::vector<std::string>{"render", file("there.sconce")}, "truth.exr"},
          {{"render", file("here.sconce")}, "before.exr"},
          {{"relight", file("here.sconce"), "--object", "block=" + middle}, "moved.exr"}}) {
      std::vector<std::string> all = words;
      all.push_back(mix);
      const test::Outcome done = picture(all, output);
      ASSERT_EQ(done.code, 0) << done.err;
    }
    const Image truth = read_image(file("truth.exr"));
    EXPECT_LE(test::error_of(truth, read_image(file("moved.exr"))), 0.04) << mix;
    EXPECT_GT(test::error_of(truth, read_image(file("before.exr"))), 0.2) << mix;
  }
  const test::Outcome unknown =
      picture({"relight", file("here.sconce"), "--object", "blok=0,0,0"}, "none.exr");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'block'"), std::string::npos) << unknown.err;
  EXPECT_EQ(picture({"relight", file("here.sconce"), "--object", "block"}, "none.exr").code, 2);
}

// The block is square: turned by a quarter it looks as it did, on other faces. Half a quarter is something
// else.
TEST_F(PutElsewhere, AQuarterTurnOfASquareBlockChangesNothing) {
  bake("room", test::two_lamp_room());
  const std::string home = fmt::format("block={},{},{}", test::kBlock.x, test::kBlock.y, test::kBlock.z);
  ASSERT_EQ(picture({"render", file("room.sconce"), "right=on"}, "home.exr").code, 0);
  for (const char* angle : {"90", "-45"})
    ASSERT_EQ(picture({"relight", file("room.sconce"), "right=on", "--object", home + "," + angle},
                      std::string(angle) + ".exr")
                  .code,
              0);
  const Image still = read_image(file("home.exr"));
  const double quarter = test::error_of(still, read_image(file("90.exr"))),
               half = test::error_of(still, read_image(file("-45.exr")));
  EXPECT_LE(quarter, 0.025);
  EXPECT_GT(half, 2 * quarter);
  const test::Outcome bad =
      picture({"relight", file("room.sconce"), "--object", home + ",round"}, "none.exr");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("'round' is no angle"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace sconce
