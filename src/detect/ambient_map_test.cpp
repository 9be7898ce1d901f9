// SPDX-License-Identifier: Apache-2.0
// The ambient texture in a furnace: walls that shine as 1 and reflect a half see 2 from everywhere.
#include "detect/ambient_map.h"

#include <gtest/gtest.h>

#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TEST(AmbientMap, Furnace) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.2f)), Vec3(0), Vec3(1), true);
  AmbientMap map(std::move(scene), 8);
  SyntheticHost host{map.world(), {{{Rgb(1), Rgb(), Rgb(0.5f)}}}};
  TransferParams params;
  params.gather = 1024, params.rays = 128, params.lights = 48, params.cluster = 64;
  map.start(host.renderer(), params);
  EXPECT_NEAR(map.detection().materials[0].response.reflectance.g, 0.5f, 1e-3f);
  ASSERT_TRUE(map.update());
  const TextureSpace& space = map.space();
  const std::vector<Rgb> reflected = map.reflected();
  ASSERT_EQ(reflected.size(), space.pixels());
  std::size_t around = 0;
  for (std::size_t i = 0; i < space.pixels(); ++i)
    if (space.covered[i]) {
      EXPECT_NEAR(map.texels()[i].g, 2, 0.06f) << i;
      EXPECT_NEAR(reflected[i].g, 1, 0.03f) << i;
    } else if (reflected[i].g > 0) {
      EXPECT_NEAR(reflected[i].g, 1, 0.03f) << i;
      ++around;
    }
  EXPECT_GT(around, 0u) << "filtering reads texels around faces";
  // Other paint: I = emission / (1 - rho), of which rho is shown.
  host.materials[0].response.reflectance = Rgb(0.75f);
  map.detect();
  ASSERT_TRUE(map.update());
  const auto lit = static_cast<std::size_t>(std::find(space.covered.begin(), space.covered.end(), 1) -
                                            space.covered.begin());
  EXPECT_NEAR(map.texels()[lit].g, 4, 0.12f);
  EXPECT_NEAR(map.reflected()[lit].g, 3, 0.1f);
  // A corner has a place in the texture: that of its face's texels.
  const PartCorners coordinates = map.coordinates();
  ASSERT_EQ(coordinates.size(), 1u);
  for (const uint32_t t : space.triangles) {
    const Vec2* uv = &coordinates[0][3 * map.world().source_triangles[t]];
    const Vec2 middle = (uv[0] + uv[1] + uv[2]) * Vec2(space.width, space.height) / 3.0f;
    EXPECT_TRUE(space.covered[static_cast<std::size_t>(middle.y) * static_cast<std::size_t>(space.width) +
                              static_cast<std::size_t>(middle.x)]);
  }
}

// Two parts; a drawing of the second's second face alone.
TEST(AmbientMap, VerticesOfParts) {
  Scene scene;
  const Id<Material> grey = add_material(scene, "grey", Rgb(0.2f));
  const std::vector<Vec3> quad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  add_part(scene, grey, {quad.begin(), quad.begin() + 3}, std::vector<Vec3>(3, {0, 0, 5}));
  std::vector<Vec3> above = quad;
  for (Vec3& p : above) p.z = 1;
  add_part(scene, grey, above, std::vector<Vec3>(6, {0, 0, 5}));
  EXPECT_EQ(scene.meshes[0].normals[2], Vec3(0, 0, 1));
  const AmbientMap map(std::move(scene), 8);
  ASSERT_EQ(map.world().size(), 3u);
  DrawRequest request;
  request.width = 4, request.height = 8;
  const std::vector<uint32_t> triangles{2};
  const std::vector<std::array<Vec2, 3>> corners{{Vec2(0, 0), Vec2(4, 0), Vec2(0, 2)}};
  request.triangles = triangles, request.corners = corners;
  const PartCorners places = map.places(request), coordinates = map.coordinates();
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0], std::vector<Vec2>(3, Vec2(2)));
  EXPECT_EQ(places[1], (std::vector<Vec2>{Vec2(2), Vec2(2), Vec2(2), Vec2(0), Vec2(1, 0), Vec2(0, 0.25f)}));
  const PartCorners clip = map.clip_places(request);
  EXPECT_EQ(clip[0], std::vector<Vec2>(3, Vec2(3)));
  EXPECT_EQ(clip[1][3], Vec2(-1));
  EXPECT_EQ(clip[1][4], Vec2(1, -1));
  // The two faces of the second part meet in the texture, too.
  EXPECT_EQ(coordinates[1][0], coordinates[1][3]);
  EXPECT_EQ(coordinates[1][2], coordinates[1][4]);
}

// A place that turns z to x and stretches x by two: what is along the slope of a face stays at right angles
// to its normal.
TEST(AmbientMap, PartsHavePlaces) {
  Scene scene;
  const Id<Material> grey = add_material(scene, "grey", Rgb(0.2f));
  const Mat4 place{{0, 0, 2, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {5, 0, 0, 1}};
  add_part(scene, grey, {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}}, std::vector<Vec3>(3, {-1, 0, 1}), place);
  EXPECT_EQ(scene.meshes[0].positions[1], Vec3(6, 0, 2));
  EXPECT_NEAR(glm::dot(scene.meshes[0].normals[0], Vec3(1, 0, 2)), 0, 1e-6f);
  EXPECT_NEAR(glm::length(scene.meshes[0].normals[0]), 1, 1e-6f);
}

}  // namespace
}  // namespace sconce
