// SPDX-License-Identifier: Apache-2.0
// Probes in closed form, by every solver that may be asked at points; planes; and both through a package.
#include "solve/points.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "gather/lit_scene.h"
#include "package/test_package.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

SolveContext context(const LitScene& lit) {
  return {lit.scene, lit.world, lit.tracer, lit.lamps};
}

BakeParams params(int samples) {
  BakeParams p;
  p.samples = samples;
  return p;
}

Light sun(const Vec3& towards, float lux) {
  Light light;
  light.name = "sun";
  light.shape = SunLight{};
  light.intensity = Rgb(lux);
  const Frame frame(towards);  // shines along -z
  light.frame =
      Mat4(glm::vec4(frame.x, 0), glm::vec4(frame.y, 0), glm::vec4(frame.z, 0), glm::vec4(0, 0, 0, 1));
  return light;
}

class Probes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Probes, testing::Values("path", "radiosity", "photon"));

// Radiance is emission / (1 - r) everywhere: E = pi L whatever faces where, no direction.
TEST_P(Probes, Furnace) {
  Scene scene;
  add_box(scene, "walls", add_material(scene, "glow", Rgb(0.8f, 0.5f, 0.2f), Rgb(10)), Vec3(-1, -2, -3),
          Vec3(2, 1, 2), true);
  const LitScene lit(std::move(scene), Grouping::one);
  const auto solver = find_solver(GetParam()).prepare(context(lit), params(16384), {});
  const Vec3 up(0, 1, 0);
  std::vector<GroupValue> out(4);
  solver->solve(Footprint::point(3, ReceiverKind::probe, {Vec3(0.5f, -0.3f, 0.2f), up, up}), out);
  for (const auto& [channel, r] : {std::pair{&Rgb::r, 0.8f}, {&Rgb::g, 0.5f}, {&Rgb::b, 0.2f}}) {
    const float expected = 10 * kPi / (1 - r);
    EXPECT_NEAR(out[0].illuminance.*channel, expected, 0.02f * expected) << r;
    for (std::size_t k = 1; k < 4; ++k)
      EXPECT_NEAR(out[k].illuminance.*channel, 0, 0.02f * expected) << r << " " << k;
  }
}

// L = E delta(w - d): e = E / 4, g = E d / 2, so that what faces the lamp shows 3/4 of it and its back, where
// -1/4 is cut, nothing.
TEST_P(Probes, ADistantLamp) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "black", Rgb(0)), Vec3(-1, 0, 1), Vec3(2, 0, 0),
           Vec3(0, 0, -2));
  const Vec3 towards = glm::normalize(Vec3(1, 2, -0.5f));
  scene.lights.push_back(sun(towards, 800));
  const LitScene lit(std::move(scene), Grouping::one);
  const auto solver = find_solver(GetParam()).prepare(context(lit), params(64), {});
  const Vec3 up(0, 1, 0);
  std::vector<GroupValue> out(4);
  solver->solve(Footprint::point(3, ReceiverKind::probe, {Vec3(0, 1, 0), up, up}), out);
  EXPECT_NEAR(out[0].illuminance.g, 200, 0.01);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(out[static_cast<std::size_t>(axis) + 1].illuminance.g, 400 * towards[axis], 0.02) << axis;
}

// g = 1/2 of the vector irradiance, whose components are differences of illuminances on opposite sides.
TEST(ProbeGrid, DirectionAgreesWithSurfaces) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.6f)), Vec3(-1, 0, -1), Vec3(1, 2, 1), true);
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(300)), Vec3(-0.8f, 1.9f, -0.2f),
           Vec3(0.5f, 0, 0), Vec3(0, 0, 0.5f));
  const LitScene lit(std::move(scene), Grouping::one);
  const auto solver = find_solver("path").prepare(context(lit), params(65536), {});
  const Vec3 at(0.2f, 0.9f, 0.1f), up(0, 1, 0);
  std::vector<GroupValue> probe(4), one(1);
  solver->solve(Footprint::point(3, ReceiverKind::probe, {at, up, up}), probe);
  for (int axis = 0; axis < 3; ++axis) {
    float difference = 0;
    for (const float side : {1.0f, -1.0f}) {
      Vec3 n(0);
      n[axis] = side;
      solver->solve(Footprint::point(5, ReceiverKind::plane, {at, n, n}), one);
      difference += side * one[0].illuminance.g / 2;
    }
    EXPECT_NEAR(probe[static_cast<std::size_t>(axis) + 1].illuminance.g, difference,
                0.01f * probe[0].illuminance.g);
  }
}

TEST(ProbeGrid, CoversTheSceneAndKnowsSolids) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.5f));
  add_box(scene, "room", white, Vec3(0, 0, 0), Vec3(4, 3, 2), true);
  add_box(scene, "block", white, Vec3(1, 0, 0), Vec3(2, 1, 1), false);  // around probe (1, 0, 0) alone
  Light bulb;
  bulb.intensity = Rgb(100);
  bulb.frame[3] = glm::vec4(3.2f, 2.5f, 1.5f, 1);
  scene.lights.push_back(bulb);
  const LitScene lit(std::move(scene), Grouping::one);
  const ProbeGrid grid = bake_probes(1, context(lit), params(64), {});
  EXPECT_EQ(grid.size, (std::array<int, 3>{4, 3, 2}));
  EXPECT_EQ(grid.position(0), Vec3(0.5f));
  EXPECT_EQ(grid.position(grid.probes() - 1), Vec3(3.5f, 2.5f, 1.5f));
  for (std::size_t i = 0; i < grid.probes(); ++i) {
    EXPECT_EQ(grid.valid[i], i == 1 ? 0 : 1) << i;
    EXPECT_EQ(grid.values[i][0].is_black(), i == 1) << i;
  }
  // Beside the block its own probe does not darken what is between.
  const Rgb beside = grid.illuminance({1.0f, 0.5f, 0.5f}, {0, 1, 0}, std::vector<Rgb>{Rgb(1)});
  EXPECT_EQ(beside, grid.illuminance({0.5f, 0.5f, 0.5f}, {0, 1, 0}, std::vector<Rgb>{Rgb(1)}));
  EXPECT_THROW(bake_probes(0.001f, context(lit), params(8), {}), UsageError);
}

// A floor alone, under a lamp 1 m above its middle probe.
TEST(ProbeGrid, BesideWhatIsFlat) {
  for (const auto& [double_sided, layers] : {std::pair{false, 1}, {true, 2}}) {
    Scene scene;
    const auto black = add_material(scene, "black", Rgb(0));
    scene.materials[black.value].double_sided = double_sided;
    add_quad(scene, "floor", black, Vec3(-1.5f, 0, 1.5f), Vec3(3, 0, 0), Vec3(0, 0, -3));
    Light bulb;
    bulb.intensity = Rgb(100);
    bulb.frame[3] = glm::vec4(0, 1.5f, 0, 1);
    scene.lights.push_back(bulb);
    const LitScene lit(std::move(scene), Grouping::one);
    const ProbeGrid grid = bake_probes(1, context(lit), params(64), {});
    EXPECT_EQ(grid.size, (std::array<int, 3>{3, layers, 3}));
    const std::size_t top = grid.probes() / 9 == 2 ? 3 : 0;
    EXPECT_EQ(grid.position(top), Vec3(-1, 0.5f, -1));
    EXPECT_EQ(std::count(grid.valid.begin(), grid.valid.end(), 1), static_cast<int>(grid.probes()));
    // e = E / 4 and g = E / 2 along y, E = 100 lx.
    const ProbeValue light = grid.at({0, 0.5f, 0}, 0);
    EXPECT_NEAR(light[0].g, 25, 1e-3);
    EXPECT_NEAR(light[2].g, 50, 1e-3);
    const ProbeValue below = grid.at({0, -0.5f, 0}, 0);
    EXPECT_EQ(below[0].is_black(), layers == 2);
  }
}

TEST(ProbeGrid, TrilinearWeightedAndCut) {
  ProbeGrid grid;
  grid.origin = {1, 2, 3};
  grid.spacing = 0.5f;
  grid.size = {3, 2, 4};
  grid.groups = 2;
  grid.valid.assign(24, 1);
  for (std::size_t i = 0; i < 24; ++i) {
    const Vec3 p = grid.position(i);
    const float field = 3 + p.x - 2 * p.y + 0.5f * p.z;  // what is linear is exact between
    grid.values.push_back({Rgb(field), Rgb(1, 0, 0), Rgb(0), Rgb(0)});
    grid.values.push_back({Rgb(0), Rgb(0), Rgb(field), Rgb(0)});
  }
  const Vec3 p(1.7f, 2.2f, 4.1f);
  const float field = 3 + p.x - 2 * p.y + 0.5f * p.z;
  const std::vector<Rgb> weights{Rgb(2), Rgb(0.5f)};
  const Rgb e = grid.illuminance(p, {0.6f, 0.8f, 0}, weights);
  EXPECT_NEAR(e.g, 2 * field + 0.5f * 0.8f * field, 1e-5);
  EXPECT_NEAR(e.r, e.g + 2 * 0.6f, 1e-5);
  EXPECT_EQ(grid.illuminance(p, {0, -1, 0}, std::vector<Rgb>{Rgb(0), Rgb(1)}), Rgb(0));
  EXPECT_EQ(grid.illuminance({-9, 2, 3}, {0, 1, 0}, weights),
            grid.illuminance({1, 2, 3}, {0, 1, 0}, weights));
  grid.valid.assign(24, 0);
  EXPECT_EQ(grid.illuminance(p, {0, 1, 0}, weights), Rgb(0));
}

TEST(Points, ThroughAPackageBitForBit) {
  const TemporaryFolder folder;
  PackageContents contents = test_package(2, 1, 16, 16);
  PlaneLight plane{"desk 1/2", {{0.1f, 0.75f, 2}, {3, 0, 0}, {0, 0, -1}, 3, 2}, 2048, {}};
  ProbeGrid grid;
  grid.origin = {0.1f, 0.2f, 0.3f};
  grid.size = {2, 1, 3};
  grid.groups = 2;
  for (int i = 0; i < 12; ++i) {
    plane.values.emplace_back(0.1f * static_cast<float>(i), 7, 1e6f);
    grid.values.push_back({Rgb(0.3f), Rgb(-1e-3f), Rgb(static_cast<float>(i)), Rgb(1, 2, 3)});
    if (i % 2 == 0) grid.valid.push_back(i == 4 ? 0 : 1);
  }
  const auto files = print_points({&plane, 1}, &grid, contents.manifest.groups);
  write_package(folder / "x.sconce", std::move(contents), files);
  const Package package = Package::open(folder / "x.sconce");
  const std::vector<PlaneLight> planes = read_planes(package);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_EQ(planes[0].name, plane.name);
  EXPECT_EQ(planes[0].samples, 2048);
  EXPECT_EQ(planes[0].plane.corner, plane.plane.corner);
  EXPECT_EQ(planes[0].plane.points().size(), 6U);
  EXPECT_EQ(planes[0].values, plane.values);
  const auto read = read_probes(package);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->values, grid.values);
  EXPECT_EQ(read->valid, grid.valid);
  EXPECT_EQ(read->origin, grid.origin);
  EXPECT_EQ(read->size, grid.size);
}

}  // namespace
}  // namespace sconce
