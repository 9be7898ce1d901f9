// SPDX-License-Identifier: Apache-2.0
// Moved lamps on the pixels of a camera, and what these mirror of them, against the bake.
#include <gtest/gtest.h>

#include "core/test_data.h"
#include "relight_run.h"

namespace sconce {
namespace {

class PixelLamps : public Relight {
 protected:
  static test::Outcome run(const Names& words, const Names& more = {}) {
    test::Outcome outcome = Relight::run(words, more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  /// The room, whose back wall and block are metal.
  void make_room(float roughness) {
    Scene scene = test::two_lamp_room();
    Material metal;
    metal.name = "metal", metal.metallic = 1, metal.roughness = roughness,
    metal.base_color = Rgb(0.9f, 0.8f, 0.6f);
    const auto id = Id<Material>(scene.materials.size());
    scene.materials.push_back(metal);
    for (const Instance& instance : scene.instances)
      if (instance.name == "back" || instance.name == "block")
        scene.meshes[instance.mesh.value].material = id;
    write_file(folder / "room.glb", write_glb(scene, "test"));
    run({"bake", file("room.glb"), "--density", "24", "--samples", "128"});
  }
  Image picture(const std::string& verb, const std::string& name, const Names& more) {
    run({verb, package, "--camera", "main", "left=on", "--others", "off", "--device", "cpu", "-o",
         file(name)},
        more);
    return read_exr(file(name));
  }
};

/// Of the 4 x 4 box means of luminance: ratio of means, and relative RMSE.
struct Difference {
  double ratio = 0, rmse = 0;
  Difference(const Image& have, const Image& want) {
    double squares = 0, sum = 0, expected = 0;
    for (int y = 0; y < want.height; y += 4)
      for (int x = 0; x < want.width; x += 4) {
        double a = 0, b = 0;
        for (int k = 0; k < 16; ++k) {
          a += static_cast<double>(luminance(have.rgb_at(x + k % 4, y + k / 4))) / 16;
          b += static_cast<double>(luminance(want.rgb_at(x + k % 4, y + k / 4))) / 16;
        }
        squares += (a - b) * (a - b), sum += a, expected += b;
      }
    const double boxes = want.width / 4.0 * (want.height / 4);
    ratio = sum / expected, rmse = std::sqrt(squares / boxes) / (expected / boxes);
  }
};

// A group by transfer, whose light metal mirrors by its lobes, is the picture of its layer, which rays
// follow.
TEST_F(PixelLamps, LobesShowWhatRaysShow) {
  make_room(0.35f);
  const std::string said =
      run({"transfer", package, "--camera", "main", "--size", "64x64", "--gather", "4096", "--cluster", "64"})
          .out;
  EXPECT_NE(said.find("camera-main.lobes.bin: lobes of"), std::string::npos) << said;
  const Names by_transfer{"--pixels", "--light", "group,name=left", "--samples", "16"},
      by_rays{"--size", "64x64", "--samples", "64"};
  const Image baked = picture("render", "baked.exr", by_rays),
              moved = picture("relight", "moved.exr", by_transfer);
  const Difference difference(moved, baked);
  EXPECT_NEAR(difference.ratio, 1, 0.03);
  EXPECT_LT(difference.rmse, 0.08);
  // And they show something.
  Names without = by_transfer;
  without.push_back("--no-reflections");
  EXPECT_GT(Difference(picture("relight", "dull.exr", without), baked).rmse, 2 * difference.rmse);
}

// Lobes go with their operator.
TEST_F(PixelLamps, LobesOfAnotherOperatorAreNamed) {
  make_room(0.35f);
  const Names transfer{"transfer", package, "--camera", "main", "--size",   "16x16",
                       "--rays",   "16",    "--lights", "16",   "--gather", "1024"};
  run(transfer);
  const std::filesystem::path lobes = std::filesystem::path(package) / "operators" / "camera-main.lobes.bin";
  const std::string before = read_file(lobes);
  run(transfer, {"--no-reflections", "--seed", "2"});
  EXPECT_FALSE(std::filesystem::exists(lobes));
  write_file(lobes, before);
  const test::Outcome outcome = test::run_sconce({"relight", package, "--camera", "main", "--pixels",
                                                  "--light", "group,name=left", "-o", file("x.exr")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("camera-main.lobes.bin: belongs to another operator"), std::string::npos)
      << outcome.err;
}

// With all coefficients kept a group by transfer is its layer but for what the bake keeps finer than the
// cloud (docs/adr/0042-exact-operator.md).
TEST_F(PixelLamps, AGroupByTheExactOperatorIsItsLayer) {
  make_room(0.35f);
  run({"transfer", package, "--gather", "4096", "--method", "exact", "--rays", "256"});
  const Names small{"--size", "64x64", "--no-reflections"};
  const Image baked = picture("render", "baked.exr", small);
  const Difference difference(
      picture("relight", "exact.exr", {"--size", "64x64", "--no-reflections", "--light", "group,name=left"}),
      baked);
  EXPECT_NEAR(difference.ratio, 1, 0.01);
  EXPECT_LT(difference.rmse, 0.02);
}

}  // namespace
}  // namespace sconce
