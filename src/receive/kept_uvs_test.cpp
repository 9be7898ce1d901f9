// SPDX-License-Identifier: Apache-2.0
#include "receive/kept_uvs.h"

#include <gtest/gtest.h>

#include "receive/test_scene.h"

namespace sconce {
namespace {

/// Two quads of 1 m, front up, beside each other; set 0 covers the unit square for both, set 1 as given.
TestScene two_quads(const Vec2& first, const Vec2& second, float side) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.5f));
  for (int i = 0; i < 2; ++i) {
    add_quad(s.scene, "q", grey, Vec3(2.0f * static_cast<float>(i), 0, 0), Vec3(1, 0, 0), Vec3(0, 0, -1));
    Mesh& mesh = s.scene.meshes.back();
    mesh.texcoords.assign(2, {});
    for (const Vec3& p : mesh.positions) {
      const Vec2 local(p.x - 2.0f * static_cast<float>(i), -p.z);
      mesh.texcoords[0].push_back(local);
      mesh.texcoords[1].push_back((i == 0 ? first : second) + side * local);
    }
  }
  s.look(Vec3(1.5f, 4, 0), Vec3(1.5f, 0, -0.5f));
  s.finish();
  return s;
}

TEST(KeptUvs, AJointLayoutIsKeptAsItStands) {
  TestScene s = two_quads(Vec2(0.05f), Vec2(0.55f, 0.05f), 0.4f);
  AtlasParams params;
  params.page_size = 100;
  s.unwrap(params);
  EXPECT_TRUE(s.atlas.report.kept_uvs);
  EXPECT_EQ(s.atlas.pages, 1);
  for (std::size_t t = 0; t < s.world.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 uv = s.world.texcoords[1][s.world.triangles[t].v[k]];
      EXPECT_NEAR(s.atlas.front[t].uv[k].x, 100 * uv.x, 1e-3f);
      EXPECT_NEAR(s.atlas.front[t].uv[k].y, 100 * uv.y, 1e-3f);
    }
  EXPECT_NE(s.atlas.front[0].chart, s.atlas.front[2].chart);
  params.page_size = 0;
  params.density = 100;
  s.unwrap(params);
  EXPECT_EQ(s.atlas.width, 256);  // 1 m is 0.4 of a page
  EXPECT_NEAR(s.atlas.density, 0.4f * 256, 1e-2f);
  params.keep_uvs = false;
  s.unwrap(params);
  EXPECT_FALSE(s.atlas.report.kept_uvs);
}

TEST(KeptUvs, OverlappingMeshesBecomeRigidBlocks) {
  TestScene s = two_quads(Vec2(0.05f), Vec2(0.25f, 0.05f), 0.4f);
  const MeshGraph graph = make_mesh_graph(s.world);
  const KeptUvs kept = find_kept_uvs(s.world, graph, std::vector<float>(s.world.size(), 0.02f));
  EXPECT_FALSE(kept.joint);
  ASSERT_EQ(kept.blocks.size(), 2u);
  EXPECT_NEAR(kept.blocks[1].size.x, 1.0f, 1e-5f);
  s.unwrap(50);
  EXPECT_TRUE(s.atlas.report.kept_uvs);
  EXPECT_NEAR(flat_area(s.atlas.front), 2 * 2500, 10);
}

TEST(KeptUvs, OverlapWithinAMeshOrInstancesIsNotKept) {
  TestScene s = two_quads(Vec2(0.05f), Vec2(0.55f, 0.05f), 0.4f);
  s.scene.instances.push_back(s.scene.instances[0]);  // the same coordinates twice: blocks, no joint layout
  s.scene.instances.back().transform[3] = glm::vec4(0, 0, 3, 1);
  s.finish();
  const MeshGraph graph = make_mesh_graph(s.world);
  const std::vector<float> texels(s.world.size(), 0.02f);
  EXPECT_FALSE(find_kept_uvs(s.world, graph, texels).joint);
  EXPECT_EQ(find_kept_uvs(s.world, graph, texels).blocks.size(), 3u);
  // One triangle of the quad folded onto the other.
  for (Mesh& mesh : s.scene.meshes) {
    const Triangle last = mesh.triangles.back();
    for (const uint32_t v : last.v) mesh.texcoords[1][v] = mesh.texcoords[1][0];
  }
  s.finish();
  EXPECT_TRUE(find_kept_uvs(s.world, make_mesh_graph(s.world), texels).blocks.empty());
}

TEST(KeptUvs, TwinsOfAJointLayoutGoToFurtherPages) {
  TestScene s = two_quads(Vec2(0.05f), Vec2(0.55f, 0.05f), 0.4f);
  s.scene.materials[0].double_sided = true;
  s.look(Vec3(1.5f, -4, 0), Vec3(1.5f, 0, -0.5f));
  s.finish();
  s.unwrap(100);
  EXPECT_TRUE(s.atlas.report.kept_uvs);
  EXPECT_EQ(s.atlas.report.twins, 4u);
  EXPECT_EQ(s.atlas.front[0].page, 0);
  EXPECT_GE(s.atlas.back[0].page, 1);
}

}  // namespace
}  // namespace sconce
