// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "receive/test_scene.h"

namespace sconce {
namespace {

TEST(BakedScene, HoldsTheWorldAndItsLightmapCoordinates) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.5f), {}, true);
  add_box(s.scene, "room", grey, Vec3(0), Vec3(4, 3, 4), true);
  add_sphere(s.scene, "ball", grey, Vec3(0), 0.4f, 12, false);
  s.scene.instances.back().transform[3] = glm::vec4(2, 1, 2, 1);
  s.scene.instances.back().transform[0] *= -1.5f;  // mirrored and stretched
  add_quad(s.scene, "sheet", grey, Vec3(2.5f, 0.5f, 1), Vec3(1, 0, 0), Vec3(0, 1, 0));
  s.scene.meshes.back().texcoords = {std::vector<Vec2>(4, Vec2(0.25f))};
  s.scene.instances.back().group_name = "g";
  s.look(Vec3(3.8f, 1.5f, 3.8f), Vec3(1, 1, 1), 1.5f);
  s.finish();
  AtlasParams params;
  params.density = 40;
  params.page_size = 128;
  params.keep_uvs = false;
  s.unwrap(params);
  ASSERT_GT(s.atlas.pages, 1);

  const BakedScene baked = make_baked_scene(s.scene, s.world, s.atlas);
  EXPECT_EQ(baked.lightmap_set, 1u);
  ASSERT_EQ(baked.pages.size(), baked.scene.instances.size());
  ASSERT_EQ(baked.twins.size(), baked.scene.instances.size());
  for (const Mesh& mesh : baked.scene.meshes) ASSERT_EQ(mesh.texcoords.size(), 2u);

  // Fronts: the same triangles, each with its own coordinates.
  std::multiset<std::tuple<float, float, float, float, float>> expected, found;
  const auto key = [](const Vec3& p, const Vec2& uv, int page) {
    return std::tuple(p.x, p.y, p.z, uv.x + static_cast<float>(page), uv.y);
  };
  const Vec2 size(static_cast<float>(s.atlas.width), static_cast<float>(s.atlas.height));
  for (std::size_t t = 0; t < s.world.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      expected.insert(key(s.world.positions[s.world.triangles[t].v[k]], s.atlas.front[t].uv[k] / size,
                          s.atlas.front[t].page));
  std::set<uint32_t> twins;
  for (const Id<Instance> twin : baked.twins)
    if (twin) twins.insert(twin.value);
  EXPECT_EQ(twins.size(), 1u);
  for (uint32_t i = 0; i < baked.scene.instances.size(); ++i) {
    const Instance& instance = baked.scene.instances[i];
    const Mesh& mesh = baked.scene[instance.mesh];
    EXPECT_EQ(instance.transform, Mat4(1.0f));
    EXPECT_GE(baked.pages[i], 0);
    if (twins.contains(i)) continue;
    for (const Triangle& triangle : mesh.triangles)
      for (const uint32_t v : triangle.v)
        found.insert(key(mesh.positions[v], mesh.texcoords[1][v], baked.pages[i]));
  }
  EXPECT_EQ(expected, found);

  // The twin: same triangles in the same order, turned over.
  for (uint32_t i = 0; i < baked.twins.size(); ++i) {
    if (!baked.twins[i]) continue;
    const Mesh& front = baked.scene[baked.scene.instances[i].mesh];
    const Mesh& back = baked.scene[baked.scene[baked.twins[i]].mesh];
    EXPECT_EQ(baked.scene[baked.twins[i]].group_name, "g");
    ASSERT_EQ(front.triangles.size(), back.triangles.size());
    for (std::size_t t = 0; t < front.triangles.size(); ++t)
      for (const auto& [k, l] : {std::pair(0, 0), std::pair(1, 2), std::pair(2, 1)})
        EXPECT_EQ(front.positions[front.triangles[t].v[static_cast<std::size_t>(k)]],
                  back.positions[back.triangles[t].v[static_cast<std::size_t>(l)]]);
    ASSERT_EQ(front.normals.empty(), back.normals.empty());
    if (!front.normals.empty()) {
      EXPECT_EQ(front.normals[0], -back.normals[0]);
    }
    EXPECT_EQ(front.texcoords[0][0], Vec2(0.25f));
  }
  // Made real again, the baked scene has the same rays' world (twins aside).
  const World again = make_world(baked.scene);
  EXPECT_EQ(again.size(), s.world.size() + 2);
}

}  // namespace
}  // namespace sconce
