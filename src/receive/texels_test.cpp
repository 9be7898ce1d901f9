// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "receive/raster.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

TEST(Texels, ConservativeRasterFindsEveryTouchedTexel) {
  const std::array<Vec2, 3> t{Vec2(1.5f, 1.5f), Vec2(6.2f, 2.1f), Vec2(2.3f, 5.7f)};
  std::vector<int> covered(64, 0);
  cover_texels(t, 8, 8, [&](int x, int y) { ++covered[static_cast<std::size_t>(8 * y + x)]; });
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      bool touched = false;
      for (int i = 0; i < 2500 && !touched; ++i) {
        const Vec2 p(static_cast<float>(x) + (static_cast<float>(i % 50) + 0.5f) / 50,
                     static_cast<float>(y) + (static_cast<float>(i / 50) + 0.5f) / 50);
        touched = cross2(t[1] - t[0], p - t[0]) > 0 && cross2(t[2] - t[1], p - t[1]) > 0 &&
                  cross2(t[0] - t[2], p - t[2]) > 0;
      }
      EXPECT_EQ(covered[static_cast<std::size_t>(8 * y + x)], touched ? 1 : 0) << x << " " << y;
    }
}

TEST(Texels, FootprintsShareOutTheSurface) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.25f, 0.5f, 0.75f));
  add_box(s.scene, "room", grey, Vec3(0), Vec3(3, 2, 4), true);
  add_sphere(s.scene, "ball", grey, Vec3(1.5f, 1, 2), 0.5f, 24, false);
  s.look(Vec3(2.8f, 1.8f, 3.8f), Vec3(1, 1, 1));
  s.finish();
  s.unwrap(37);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  EXPECT_EQ(s.atlas.report.invalid, 0u);
  double sum = 0, expected = 0;
  for (std::size_t t = 0; t < s.world.size(); ++t) expected += static_cast<double>(s.world.area(t));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Footprint f = receivers.footprint(i);
    sum += static_cast<double>(f.area);
    EXPECT_EQ(f.kind, ReceiverKind::texel);
    EXPECT_EQ(f.pieces.back().cumulative, 1.0f);
    if (i > 0) {
      EXPECT_LT(receivers.texel(i - 1), receivers.texel(i));
    }
    const SurfacePoint p = f.sample(Vec2(0.3f, 0.7f));
    EXPECT_NEAR(glm::length(p.shading_normal), 1.0f, 1e-4f);
    EXPECT_GT(glm::dot(p.shading_normal, p.geometric_normal), 0.8f);
  }
  EXPECT_NEAR(sum / expected, 1.0, 1e-4);
  EXPECT_EQ(receivers.tiles(), (receivers.size() + 255) / 256);
  const Rgb albedo = receivers.albedo(s.scene, receivers.size() / 2);
  EXPECT_NEAR(albedo.r, 0.25f, 1e-5f);
  EXPECT_NEAR(albedo.b, 0.75f, 1e-5f);
}

TEST(Texels, TwinsLookTheOtherWay) {
  TestScene s;
  add_quad(s.scene, "sheet", add_material(s.scene, "m", Rgb(0.5f), {}, true), Vec3(0), Vec3(1, 0, 0),
           Vec3(0, 1, 0));
  s.look(Vec3(0.5f, 0.5f, 2), Vec3(0.5f, 0.5f, 0));
  s.look(Vec3(0.5f, 0.5f, -2), Vec3(0.5f, 0.5f, 0));
  s.finish();
  s.unwrap(10);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  double front = 0, back = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Footprint f = receivers.footprint(i);
    const float z = f.sample(Vec2(0.5f)).geometric_normal.z;
    EXPECT_EQ(f.sample(Vec2(0.5f)).shading_normal.z, z);
    (z > 0 ? front : back) += static_cast<double>(f.area);
  }
  EXPECT_NEAR(front, 1, 1e-5);
  EXPECT_NEAR(back, 1, 1e-5);
}

/// The floor of a room with a box on it: without a bottom, with one on the floor, with one sunk in.
class Buried : public testing::TestWithParam<float> {};

TEST_P(Buried, FloorUnderABoxIsInvalidUpToTheContactLine) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.5f), {}, true);
  const Id<Instance> room = add_box(s.scene, "room", grey, Vec3(-2, 0, -2), Vec3(2, 3, 2), true);
  add_box(s.scene, "box", grey, Vec3(-0.51f, GetParam(), -0.33f), Vec3(0.52f, 1, 0.47f), false);
  s.look(Vec3(1.8f, 1.5f, 1.8f), Vec3(0, 0.5f, 0));
  s.finish();
  s.unwrap(20);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  EXPECT_GT(s.atlas.report.invalid, 250u);
  double open = 0, hidden = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    for (const FootprintPiece& piece : receivers.footprint(i).pieces) {
      const Vec3 c = (piece.p0 + piece.p1 + piece.p2) / 3.0f;
      if (piece.geometric_normal.y < 0.5f || c.y > 0.001f) continue;
      const bool under = c.x > -0.51f && c.x < 0.52f && c.z > -0.33f && c.z < 0.47f;
      const double area =
          0.5 * static_cast<double>(glm::length(glm::cross(piece.p1 - piece.p0, piece.p2 - piece.p0)));
      (under ? hidden : open) += area;
    }
  }
  EXPECT_LT(hidden, 0.05);  // of 0.824 m2: half cells along 3.66 m of contact
  EXPECT_NEAR(open, 16 - 1.03 * 0.8, 0.12);
  EXPECT_EQ(s.world.instances[0], room);
}
INSTANTIATE_TEST_SUITE_P(Boxes, Buried, testing::Values(0.0f, 0.001f, -0.1f));

TEST(Texels, UndersideOfATableIsLegalToSee) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.5f), {}, true);
  add_box(s.scene, "room", grey, Vec3(-2, 0, -2), Vec3(2, 3, 2), true);
  add_quad(s.scene, "table", grey, Vec3(-0.6f, 0.7f, 0.6f), Vec3(1.2f, 0, 0), Vec3(0, 0, -1.2f));
  s.look(Vec3(1.8f, 1.5f, 1.8f), Vec3(0, 0.5f, 0));
  s.finish();
  s.unwrap(20);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  EXPECT_EQ(s.atlas.report.invalid, 0u);
  EXPECT_EQ(s.atlas.report.twins, 2u);
}

}  // namespace
}  // namespace sconce
