// SPDX-License-Identifier: Apache-2.0
// Light through coloured panes has their colour.
#include "detect/tinted_bounces.h"

#include <gtest/gtest.h>

#include "detect/test_rig.h"

namespace sconce {
namespace {

const Rgb kEmission(1, 0.5f, 2), kTau(0.9f, 0.3f, 0);

/// A room in two by a pane at x = 0.5. A wall at 0.25 shines towards it, a small plate behind it looks at it;
/// all else is black, so that the plate's light is tau emission F.
struct TwoRooms {
  static Scene scene() {
    Scene scene;
    add_box(scene, "rooms", add_material(scene, "black", Rgb(0.2f)), Vec3(0), Vec3(1), true);
    add_quad(scene, "pane", add_material(scene, "pane", Rgb(0.2f)), {0.5f, 0, 0}, {0, 1, 0}, {0, 0, 1});
    add_quad(scene, "wall", add_material(scene, "wall", Rgb(0.2f)), {0.25f, 0, 0}, {0, 1, 0}, {0, 0, 1});
    add_quad(scene, "plate", Id<Material>(0), {0.75f, 0.48f, 0.48f}, {0, 0, 0.04f}, {0, 0.04f, 0});
    return scene;
  }
  static std::vector<SyntheticMaterial> materials(const Rgb& tau) {
    return {{}, {{Rgb(), tau, Rgb()}}, {{kEmission, Rgb(), Rgb()}}};
  }
  static TransferParams params() {
    TransferParams params = quick();
    params.rays = 2048, params.lights = 256, params.movable = true;
    return params;
  }
  explicit TwoRooms(const Rgb& tau) : rig(scene(), materials(tau), {}, params()) {}

  Rgb on_plate() const {
    const std::size_t first = rig.world.positions.size() - 4;
    Rgb mean;
    for (std::size_t v = first; v < first + 4; ++v) mean += rig.radiosity.ambient()[v] / 4.0f;
    return mean;
  }
  Rig rig;
};

/// Of a unit square for an element that faces its middle from a distance.
float form_factor(float distance) {
  const float a = 0.5f / distance, root = std::sqrt(1 + a * a);
  return 4 / kPi * a / root * std::atan(a / root);
}

TEST(TintedBounces, BehindAPane) {
  TwoRooms rooms(kTau);
  ASSERT_TRUE(rooms.rig.radiosity.update());
  const Rgb expected = form_factor(0.5f) * kTau * kEmission, light = rooms.on_plate();
  EXPECT_NEAR(light.r, expected.r, 0.03f * expected.r);
  EXPECT_NEAR(light.g, expected.g, 0.03f * expected.g);
  EXPECT_NEAR(light.b, 0, 1e-3f * kEmission.b);
}

// Within a budget all channels come to the same answer, and after things moved each has its own again.
TEST(TintedBounces, GoOn) {
  TwoRooms rooms(kTau);
  RealtimeRadiosity& radiosity = rooms.rig.radiosity;
  ASSERT_TRUE(radiosity.update());
  const std::vector<Rgb> whole(radiosity.ambient().begin(), radiosity.ambient().end());
  rooms.rig.host.materials[2].response.emission = Rgb(3);
  FrameReport report = radiosity.update({1});
  EXPECT_GT(report.coarse, 0u);
  rooms.rig.host.materials[2].response.emission = kEmission;
  do report = radiosity.update({1});
  while (report.coarse > 0);
  EXPECT_EQ(std::vector<Rgb>(radiosity.ambient().begin(), radiosity.ambient().end()), whole);

  for (Instance& instance : rooms.rig.scene.instances)
    if (instance.name == "plate") instance.transform[3] = {-0.15f, 0, 0, 1};
  rooms.rig.world = make_world(rooms.rig.scene);
  rooms.rig.tracer = Tracer(rooms.rig.scene, rooms.rig.world);
  radiosity.follow();
  radiosity.wait();
  ASSERT_TRUE(radiosity.update());
  const Rgb expected = form_factor(0.35f) * kTau * kEmission, light = rooms.on_plate();
  EXPECT_NEAR(light.r, expected.r, 0.03f * expected.r);
  EXPECT_NEAR(light.g, expected.g, 0.03f * expected.g);
  EXPECT_NEAR(light.b, 0, 1e-3f * kEmission.b);
}

// One operator is enough as long as nothing is coloured, and what rounding makes is no colour.
TEST(TintedBounces, AnOperatorPerChannelWhereNeeded) {
  Detection detection;
  detection.materials.resize(2);
  EXPECT_TRUE(tints(detection).empty());
  detection.materials[1].response.transmission = Rgb(0.502f, 0.5f, 0.498f);
  ASSERT_EQ(tints(detection).size(), 1u);
  EXPECT_NEAR(tints(detection)[0][1], 0.5f, 1e-6f);
  detection.materials[1].response.transmission = Rgb(0.03f, 0, 0);
  const std::vector<std::vector<float>> three{{0, 0.03f}, {0, 0}, {0, 0}};
  EXPECT_EQ(tints(detection), three);
}

}  // namespace
}  // namespace sconce
