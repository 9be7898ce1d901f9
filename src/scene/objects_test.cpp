// SPDX-License-Identifier: Apache-2.0
// Objects put elsewhere and turned, and home again.
#include "scene/objects.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace sconce {
namespace {

class Objects : public testing::Test {
 protected:
  void SetUp() override {
    add_box(scene, "room", add_material(scene, "grey", Rgb(0.5f)), Vec3(-5), Vec3(5), true);
    add_box(scene, "bar", Id<Material>(0), Vec3(1, 0, 1), Vec3(3, 1, 1.5f), false);
    world = home = make_world(scene);
  }
  Bounds bar() const { return object_bounds(scene, world, "bar"); }
  Scene scene;
  World world, home;
};

TEST_F(Objects, ShiftsAreSums) {
  const ObjectPlaces places(scene, world);
  const Vec3 by(0.1f, 0.2f, -0.7f);
  places.place({{"bar", {by}}}, scene, world);
  EXPECT_EQ(scene.instances[1].transform[3], glm::vec4(by, 1));
  for (std::size_t t = 0; t < world.size(); ++t)
    for (const uint32_t v : world.triangles[t].v)
      EXPECT_EQ(world.positions[v],
                scene[world.instances[t]].name == "bar" ? home.positions[v] + by : home.positions[v]);
  EXPECT_EQ(world.face_normals, home.face_normals);
}

// 2 x 0.5 m become 0.5 x 2 m around the same middle; the face that looked along x looks along -z then, as
// seen from above counter-clockwise.
TEST_F(Objects, AQuarterTurn) {
  const ObjectPlaces places(scene, world);
  places.place({{"bar", {Vec3(0, 1, 0), 90}}}, scene, world);
  const Bounds box = bar();
  EXPECT_LT(glm::distance(box.lo, Vec3(1.75f, 1, 0.25f)), 1e-5f);
  EXPECT_LT(glm::distance(box.hi, Vec3(2.25f, 2, 2.25f)), 1e-5f);
  std::size_t turned = 0;
  for (std::size_t t = 0; t < world.size(); ++t)
    if (scene[world.instances[t]].name == "bar" && home.face_normals[t].x > 0.5f) {
      EXPECT_LT(glm::distance(world.face_normals[t], Vec3(0, 0, -1)), 1e-6f);
      ++turned;
    }
  EXPECT_EQ(turned, 2u);
  const World again = make_world(scene);  // what the scene says is the same
  for (std::size_t v = 0; v < world.positions.size(); ++v)
    EXPECT_LT(glm::distance(again.positions[v], world.positions[v]), 1e-5f);

  const Placement p = places.placements(scene, {{"bar", {Vec3(0, 1, 0), 90}}})[1];
  const SurfacePoint at{{1, 2, 3}, {0, 0, 1}, {0.6f, 0.8f, 0}}, back = p.home(p.there(at));
  EXPECT_LT(glm::distance(back.position, at.position), 1e-5f);
  EXPECT_LT(glm::distance(back.geometric_normal, at.geometric_normal), 1e-6f);

  places.place({}, scene, world);
  EXPECT_EQ(world.positions, home.positions);
  EXPECT_EQ(world.face_normals, home.face_normals);
  EXPECT_EQ(scene.instances[1].transform, Mat4(1));
}

}  // namespace
}  // namespace sconce
