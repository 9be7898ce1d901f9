// SPDX-License-Identifier: Apache-2.0
// The photon map's own properties; closed forms of the solver are in solve_test.cpp.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/photon_map.h"

namespace sconce {
namespace {

struct Rig : LitScene {
  explicit Rig(Scene s) : LitScene(std::move(s), Grouping::per_light) {}
  SolveContext context() const { return {scene, world, tracer, lamps}; }
  std::vector<GroupValue> solve(const BakeParams& params, const SurfacePoint& at) const {
    return solve(params, at, context());
  }
  std::vector<GroupValue> solve(const BakeParams& params, const SurfacePoint& at,
                                const SolveContext& asked) const {
    std::vector<GroupValue> out(scene.groups.size());
    find_solver("photon")
        .prepare(asked, params, {})
        ->solve(Footprint::point(3, ReceiverKind::plane, at), out);
    return out;
  }
};

Light bulb(const Vec3& p, const Rgb& intensity) {
  Light light;
  light.name = "bulb";
  light.intensity = intensity;
  light.frame[3] = glm::vec4(p, 1);
  return light;
}

SurfacePoint floor_at(float x, float z) {
  return {Vec3(x, 0, z), Vec3(0, 1, 0), Vec3(0, 1, 0)};
}

double sum(const PhotonMap& map, const PhotonMap::Density& d) {
  double e = 0;
  for (const auto& [distance2, i] : d.nearest) e += static_cast<double>(map[i].flux.g * d.scale);
  return e;
}

// Inside a sphere of radius 2 a bulb of 100 cd gives 25 lx directly, 25 r / (1 - r) reflected. With 400
// photons an estimate scatters by 1 / sqrt(399) = 5 %, so the mean of 200 by 0.4 % (some overlap).
TEST(PhotonMap, DensityInsideASphere) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.7f)), Vec3(0), 2, 96, true);
  scene.lights.push_back(bulb(Vec3(0), Rgb(100)));
  const Rig rig(std::move(scene));
  const PhotonMap map(rig.context(), -1, 100000, 1, {});
  EXPECT_NEAR(static_cast<double>(map.size()), 1e5 / (1 - 0.7), 2e3) << "mean number of landings 1 / (1 - r)";
  PhotonMap::Density d;
  double direct = 0, all = 0, squares = 0;
  const int n = 200;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 out = square_to_sphere(sobol_pair(i, 0, 1));
    map.density({1.999f * out, -out, 400, 0, 0}, d);
    direct += sum(map, d) / n;
    map.density({1.999f * out, -out, 400}, d);
    EXPECT_EQ(d.nearest.size(), 399u) << "the last one only says how large the disk is";
    EXPECT_FALSE(d.sparse);
    EXPECT_LT(d.offset, 0.15f);
    all += sum(map, d) / n;
    squares += sum(map, d) * sum(map, d) / n;
  }
  EXPECT_NEAR(direct, 25, 0.2);
  EXPECT_NEAR(all, 25 / 0.3, 0.01 * 25 / 0.3);
  EXPECT_NEAR(std::sqrt(squares - all * all) / all, 0.05, 0.02);
}

TEST(PhotonMap, EdgesAndEmptinessAreSeen) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.5f));
  add_quad(scene, "floor", white, Vec3(-1, 0, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  add_quad(scene, "far", white, Vec3(-1, 0, 40), Vec3(0, 0, 2), Vec3(2, 0, 0));
  scene.lights.push_back(bulb(Vec3(0, 1, 0), Rgb(100)));
  const Rig rig(std::move(scene));
  const PhotonMap map(rig.context(), 1, 1 << 17, 1, {});
  PhotonMap::Density d;
  map.density({Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0)}, d);
  EXPECT_LT(d.offset, 0.2f);
  EXPECT_NEAR(sum(map, d), 100 / std::pow(1 + 0.05, 1.5), 25) << "one in sqrt(63), two deviations";
  map.density({Vec3(1, 0, 0), Vec3(0, 1, 0)}, d);
  EXPECT_NEAR(d.offset, 4 / (3 * kPi), 0.15) << "centroid of half a disk";
  map.density({Vec3(0, 0, 41), Vec3(0, 1, 0)}, d);
  EXPECT_TRUE(d.sparse);
  map.density({Vec3(0.1f, 0, 0.2f), Vec3(0, -1, 0)}, d);
  EXPECT_TRUE(d.nearest.empty()) << "photons of the other side do not count";
}

// Two rooms share a thin wall and the floor below it; the lamp is in one of them.
TEST(Photon, NothingLeaksUnderAThinWall) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.8f));
  add_box(scene, "rooms", white, Vec3(-2, 0, -1), Vec3(2, 2, 1), true);
  add_box(scene, "wall", white, Vec3(-0.002f, 0, -1), Vec3(0.002f, 2, 1), false);
  scene.lights.push_back(bulb(Vec3(-1, 1, 0), Rgb(100)));
  const Rig rig(std::move(scene));
  BakeParams params;
  params.samples = 2048;
  for (const float x : {0.02f, 0.2f, 1.0f})
    EXPECT_EQ(rig.solve(params, floor_at(x, 0.1f))[0].illuminance, Rgb()) << x;
  EXPECT_GT(rig.solve(params, floor_at(-0.2f, 0.1f))[0].illuminance.g, 50);
}

Scene two_lamps() {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f, 0.6f, 0.5f)), Vec3(-1, 0, -1), Vec3(1, 2, 1),
          true);
  scene.lights = {bulb(Vec3(0.3f, 1.5f, 0.2f), Rgb(100)), bulb(Vec3(-0.5f, 0.4f, 0), Rgb(1))};
  return scene;
}

TEST(Photon, AgreesWithThePathSolverAtEveryBounceWithAndWithoutGather) {
  const Rig rig(two_lamps());
  const SurfacePoint at = floor_at(0.2f, -0.1f);
  for (const int bounces : {0, 1, 2, -1}) {
    BakeParams params;
    params.samples = 16384;
    params.bounces = bounces;
    std::vector<GroupValue> expected(2);
    find_solver("path")
        .prepare(rig.context(), params, {})
        ->solve(Footprint::point(3, ReceiverKind::plane, at), expected);
    const auto gathered = rig.solve(params, at);
    params.final_gather = false;
    params.photons = 1 << 20;
    const auto seen = rig.solve(params, at);
    for (std::size_t g = 0; g < 2; ++g) {
      const double e = static_cast<double>(expected[g].illuminance.g);
      EXPECT_NEAR(gathered[g].illuminance.g, e, 0.01 * e) << bounces << " bounces, group " << g;
      // Half of 399 photons a group, of which 8 estimates share most: up to 7 % of the reflected part.
      EXPECT_NEAR(seen[g].illuminance.g, e, 0.08 * e) << bounces << " bounces, group " << g;
    }
  }
}

TEST(Photon, SameBitsAtAnyThreadCountAndForSomeGroupsOnly) {
  const Rig rig(two_lamps());
  BakeParams params;
  params.samples = 64;
  const SurfacePoint at = floor_at(0.2f, -0.1f);
  const auto all = rig.solve(params, at);
  {
    const ThreadLimit one(1);
    const auto alone = rig.solve(params, at);
    EXPECT_EQ(alone[0].illuminance, all[0].illuminance);
    EXPECT_EQ(alone[1].error, all[1].error);
  }
  const std::vector<uint8_t> wanted{0, 1};
  SolveContext some{rig.scene, rig.world, rig.tracer, rig.lamps, nullptr, nullptr, wanted};
  const auto second = rig.solve(params, at, some);
  EXPECT_EQ(second[0].illuminance, Rgb());
  EXPECT_EQ(second[1].illuminance, all[1].illuminance);
}

}  // namespace
}  // namespace sconce
