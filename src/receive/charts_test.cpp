// SPDX-License-Identifier: Apache-2.0
// Cutting and laying flat, on shapes whose answer is known.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "receive/test_scene.h"

namespace sconce {
namespace {

std::vector<Chart> unwrap_all(const World& world, float texel = 0.02f) {
  const MeshGraph graph = make_mesh_graph(world);
  std::vector<Chart> charts;
  for (const Patch& patch : cut_into_patches(world, graph, std::vector<float>(world.size(), texel),
                                             std::vector<uint8_t>(world.size(), 0)))
    parameterize(world, graph, patch, charts);
  return charts;
}

/// Every triangle once, unmirrored, areas kept within the tolerance chart by chart, no overlap.
void expect_sound(const World& world, const std::vector<Chart>& charts) {
  std::multiset<uint32_t> seen;
  for (const Chart& chart : charts) {
    double flat = 0;
    for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
      seen.insert(chart.triangles[i]);
      EXPECT_GT(signed_area(chart.uv[i]), 0.0f);
      flat += static_cast<double>(signed_area(chart.uv[i]));
    }
    EXPECT_NEAR(flat / chart.area, 1.0, 1e-3);
    EXPECT_FALSE(overlaps_itself(chart.uv));
  }
  EXPECT_EQ(seen.size(), world.size());
  EXPECT_EQ(std::set<uint32_t>(seen.begin(), seen.end()).size(), world.size());
}

TEST(Charts, CubeHasSixSquares) {
  Scene scene;
  add_box(scene, "cube", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), Vec3(2), false);
  const World world = make_world(scene);
  const auto charts = unwrap_all(world);
  ASSERT_EQ(charts.size(), 6u);
  expect_sound(world, charts);
  for (const Chart& chart : charts) {
    EXPECT_NEAR(chart.area, 4.0, 1e-5);
    EXPECT_NEAR(chart.stretch, 1.0, 1e-5);
    EXPECT_NEAR(chart.size.x, 2.0f, 1e-4f);  // turned into its smallest rectangle
    EXPECT_NEAR(chart.size.y, 2.0f, 1e-4f);
  }
}

TEST(Charts, CylinderUnrollsWithoutStretch) {
  Scene scene;
  add_cylinder(scene, add_material(scene, "grey", Rgb(0.5f)), 1.0f, 2.0f, 96);
  const World world = make_world(scene);
  const auto charts = unwrap_all(world);
  EXPECT_LE(charts.size(), 6u);
  expect_sound(world, charts);
  for (const Chart& chart : charts) EXPECT_NEAR(chart.stretch, 1.0, 2e-3);
}

TEST(Charts, SphereStretchesLittle) {
  Scene scene;
  add_sphere(scene, "ball", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), 1.0f, 32, false);
  const World world = make_world(scene);
  const auto charts = unwrap_all(world);
  EXPECT_LE(charts.size(), 24u);
  expect_sound(world, charts);
  for (const Chart& chart : charts) EXPECT_LT(chart.stretch, 1.25);
}

TEST(Charts, FacesOfASharpEdgeStayApartButTinyOnesJoin) {
  // A strip of facets turning 20 degrees each, with face normals.
  Scene scene;
  Mesh mesh;
  mesh.material = add_material(scene, "grey", Rgb(0.5f));
  Vec3 at(0);
  mesh.positions = {at, Vec3(0, 0, -1)};
  for (int i = 0; i < 3; ++i) {
    const float a = static_cast<float>(i) * 20.0f * kPi / 180;
    at += Vec3(std::cos(a), std::sin(a), 0);
    mesh.positions.push_back(at);
    mesh.positions.push_back(at + Vec3(0, 0, -1));
    const auto b = static_cast<uint32_t>(2 * i);
    mesh.triangles.push_back({{b, b + 2, b + 3}});
    mesh.triangles.push_back({{b, b + 3, b + 1}});
  }
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  scene.instances.back().mesh = Id<Mesh>(0);
  const World world = make_world(scene);
  EXPECT_EQ(unwrap_all(world, 0.02f).size(), 3u);  // facets of 50 x 50 texels
  EXPECT_EQ(unwrap_all(world, 2.0f).size(), 1u);   // facets of half a texel
}

TEST(Charts, SpiralRampIsCutWhereItWouldLieOnItself) {
  // Two turns of a flat ramp: every normal is nearly up, yet one projection covers the same ground twice.
  Scene scene;
  Mesh mesh;
  mesh.material = add_material(scene, "grey", Rgb(0.5f));
  constexpr uint32_t kSteps = 128;
  for (uint32_t i = 0; i <= kSteps; ++i) {
    const float a = 4 * kPi * static_cast<float>(i) / kSteps;
    for (const float r : {1.0f, 2.0f})
      mesh.positions.emplace_back(r * std::cos(a), 0.05f * a, -r * std::sin(a));
    if (i == kSteps) break;
    mesh.triangles.push_back({{2 * i, 2 * i + 1, 2 * i + 3}});
    mesh.triangles.push_back({{2 * i, 2 * i + 3, 2 * i + 2}});
  }
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  scene.instances.back().mesh = Id<Mesh>(0);
  const World world = make_world(scene);
  const auto charts = unwrap_all(world);
  EXPECT_GE(charts.size(), 2u);
  expect_sound(world, charts);
}

TEST(Charts, OverlapIsFoundAndNeighboursAreNone) {
  const std::array<Vec2, 3> a{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}, b{Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  const std::array<Vec2, 3> c{Vec2(0.1f, 0.1f), Vec2(1.1f, 0.1f), Vec2(0.1f, 1.1f)};
  EXPECT_FALSE(overlaps_itself(std::vector{a, b}));
  EXPECT_TRUE(overlaps_itself(std::vector{a, c}));
  EXPECT_TRUE(overlaps_itself(std::vector{a, a}));
}

TEST(Charts, TwinIsTheMirrorImage) {
  Scene scene;
  add_quad(scene, "q", add_material(scene, "m", Rgb(0.5f)), Vec3(0), Vec3(3, 0, 0), Vec3(0, 1, 0));
  const World world = make_world(scene);
  const auto charts = unwrap_all(world);
  const Chart twin = make_twin(charts[0]);
  for (std::size_t i = 0; i < twin.uv.size(); ++i)
    EXPECT_NEAR(signed_area(twin.uv[i]), -signed_area(charts[0].uv[i]), 1e-6f);
  EXPECT_EQ(twin.size, charts[0].size);
}

}  // namespace
}  // namespace sconce
