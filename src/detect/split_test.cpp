// SPDX-License-Identifier: Apache-2.0
#include "detect/split.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "scene/shapes.h"
#include "scene/world.h"

namespace sconce {
namespace {

TEST(Split, FacesThatMetStillMeet) {
  Scene scene;
  const auto grey = add_material(scene, "grey", Rgb(0.5f));
  add_box(scene, "room", grey, Vec3(0), Vec3(3, 2, 1), true);
  add_sphere(scene, "ball", grey, Vec3(0), 1, 5, false);
  const World before = make_world(scene), after = make_world(split_large_faces(scene, 0.4f));
  double area[2] = {0, 0};
  std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
  const auto key = [&](uint32_t v) {
    const Vec3& p = after.positions[v];
    return std::array{std::lround(1e4f * p.x), std::lround(1e4f * p.y), std::lround(1e4f * p.z)};
  };
  for (std::size_t t = 0; t < before.size(); ++t) area[0] += static_cast<double>(before.area(t));
  for (std::size_t t = 0; t < after.size(); ++t) {
    area[1] += static_cast<double>(after.area(t));
    for (std::size_t e = 0; e < 3; ++e) {
      const uint32_t a = after.triangles[t].v[e], b = after.triangles[t].v[(e + 1) % 3];
      EXPECT_LE(glm::distance(after.positions[a], after.positions[b]), 0.4f);
      ++edges[std::minmax(key(a), key(b))];
    }
  }
  EXPECT_NEAR(area[1], area[0], 1e-4);
  EXPECT_GT(after.size(), 10 * before.size() / 4);
  for (const auto& [edge, faces] : edges) EXPECT_EQ(faces, 2) << "closed before, open now";
}

TEST(Split, MeasuresInTheWorldAndInterpolates) {
  Scene scene;
  add_quad(scene, "wall", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  Mesh& mesh = scene.meshes[0];
  mesh.texcoords = {{}};
  for (const Vec3& p : mesh.positions) mesh.texcoords[0].emplace_back(p.x, p.y);
  EXPECT_EQ(make_world(split_large_faces(scene, 1.5f)).size(), 2u);
  scene.instances[0].transform = Mat4(8.0f);
  scene.instances[0].transform[3][3] = 1;
  const Scene split = split_large_faces(scene, 1.5f);
  EXPECT_GT(make_world(split).size(), 64u);
  const Mesh& fine = split.meshes[0];
  for (std::size_t v = 0; v < fine.positions.size(); ++v) {
    EXPECT_EQ(fine.texcoords[0][v], Vec2(fine.positions[v]));
    EXPECT_EQ(fine.normals[v], Vec3(0, 0, 1));
  }
  EXPECT_THROW(split_large_faces(scene, 0), Error);
}

}  // namespace
}  // namespace sconce
