// SPDX-License-Identifier: Apache-2.0
// The example of global illumination with things that move.
#include <gtest/gtest.h>

#include "core/files.h"
#include "image/io.h"
#include "process.h"

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

}  // namespace
}  // namespace sconce
