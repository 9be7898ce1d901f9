// SPDX-License-Identifier: Apache-2.0
// Light stays where walls keep it, with every solver: a dark room behind a thin wall is black, and behind a
// door that is nearly closed it is as dark as path tracing says.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/parallel.h"
#include "core/test_data.h"
#include "gather/lit_scene.h"
#include "import/import.h"
#include "solve/solver.h"
#include "solve/test_scenes.h"

namespace sconce {
namespace {

/// A scene with a lightmap.
struct Rig : LitAtlas {
  Rig(Scene s, int page) : LitAtlas(std::move(s), Grouping::one, page) {}

  struct Texel {
    Vec3 position;
    GroupValue value;
  };
  /// Every `step`-th texel that `asked` for.
  template <class Asked>
  std::vector<Texel> solve(const char* solver, int samples, std::size_t step, Asked&& asked) const {
    BakeParams params;
    params.samples = samples;
    const auto made =
        find_solver(solver).prepare({scene, world, tracer, lamps, &atlas, &receivers}, params, {});
    std::vector<Texel> texels;
    std::vector<Footprint> footprints;
    for (std::size_t i = step / 2; i < receivers.size(); i += step) {
      Footprint footprint = receivers.footprint(i);
      const Vec3 p = footprint.sample(Vec2(0.5f)).position;
      if (!asked(p)) continue;
      texels.push_back({p, {}});
      footprints.push_back(std::move(footprint));
    }
    parallel_for(texels.size(), 4, [&](std::size_t i) { made->solve(footprints[i], {&texels[i].value, 1}); });
    return texels;
  }
};

class Leaks : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Rows, Leaks, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const SolverRow& row : solvers())
                             if (!row.runs_program) names.emplace_back(row.name);
                           return names;
                         }()),
                         [](const auto& row) { return row.param; });

// One centimetre of wall, or a sheet without any; the floor and the ceiling run through.
TEST_P(Leaks, ARoomBehindAThinWallIsBlack) {
  for (const float thickness : {0.01f, 0.0f}) {
    const Rig rig(partition(thickness), 64);
    // Texels across the wall lie in both rooms.
    const auto dark = rig.solve(GetParam().c_str(), 64, 1, [](const Vec3& p) {
      return p.x > 0.2f && p.x < 3.001f && p.y > -0.001f && p.y < 2.501f && p.z > -0.001f && p.z < 2.001f;
    });
    EXPECT_GT(dark.size(), 500u);
    for (const auto& texel : dark)
      ASSERT_EQ(texel.value.illuminance, Rgb()) << texel.position.x << " " << texel.position.y << " "
                                                << texel.position.z << ", wall of " << thickness;
    const auto lit = rig.solve(GetParam().c_str(), 64, 16,
                               [](const Vec3& p) { return p.x < -0.5f && p.y > -0.001f && p.y < 2.3f; });
    for (const auto& texel : lit) EXPECT_GT(luminance(texel.value.illuminance), 0) << texel.position.x;
  }
}

// Through the open door the bulb lights by the law of inverse squares what it sees, and by reflection alone
// what it does not; all solvers agree on that. Shut, the other room is black.
TEST_P(Leaks, TwoRoomsWithADoor) {
  const LitScene open(two_rooms(true), Grouping::one), shut(two_rooms(false), Grouping::one);
  const auto at = [&](const LitScene& lit, const std::string& solver, const Vec3& p, int bounces,
                      int samples) {
    BakeParams params;
    params.samples = samples;
    params.bounces = bounces;
    GroupValue value;
    const Vec3 up(0, 1, 0);
    find_solver(solver)
        .prepare({lit.scene, lit.world, lit.tracer, lit.lamps}, params, {})
        ->solve(Footprint::point(5, ReceiverKind::plane, {p, up, up}), {&value, 1});
    return static_cast<double>(value.illuminance.g);
  };
  const Vec3 seen(1, 0, 0), hidden(1, 0, 1.3f);
  const double squared = 2.5 * 2.5 + 1.5 * 1.5;
  EXPECT_NEAR(at(open, GetParam(), seen, 0, 64), 100 * 1.5 / std::pow(squared, 1.5), 1e-3);
  EXPECT_EQ(at(open, GetParam(), hidden, 0, 64), 0);
  const double reflected = at(open, "path", hidden, -1, 1 << 17);
  EXPECT_GT(reflected, 0.1);
  EXPECT_NEAR(at(open, GetParam(), hidden, -1, 1 << 14), reflected, 0.05 * reflected);
  for (const Vec3& p : {seen, hidden, Vec3(0.06f, 0, 0)})
    EXPECT_EQ(at(shut, GetParam(), p, -1, 1024), 0) << p.x;
}

// Veach's room with the door turned about its hinge from 17 degrees to 4.
TEST(Door, VeachAjarNearlyClosed) {
  const std::filesystem::path file = test_data() / "glb/veach-ajar.glb";
  SCONCE_NEEDS_DATA(file);
  Scene scene = import_scene(file);
  const Vec3 hinge(-2.798f, 0, -4.67f);
  int turned = 0;
  for (Instance& instance : scene.instances)
    if (instance.name.find("DoorBSDF") != std::string::npos ||
        instance.name.find("DoorHandle") != std::string::npos) {
      instance.transform = glm::translate(Mat4(1), hinge) *
                           glm::rotate(Mat4(1), glm::radians(13.0f), Vec3(0, 1, 0)) *
                           glm::translate(Mat4(1), -hinge) * instance.transform;
      ++turned;
    }
  ASSERT_EQ(turned, 2);
  const Rig rig(std::move(scene), 256);
  const auto here = [](const Vec3& p) { return p.x > -2.78f && p.y > 0.01f && p.y < 3.79f; };
  const auto path = rig.solve("path", 8192, 61, here), radiosity = rig.solve("radiosity", 1024, 61, here);
  double reference = 0, mean = 0, squares = 0, noise = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double p = static_cast<double>(luminance(path[i].value.illuminance)),
                 r = static_cast<double>(luminance(radiosity[i].value.illuminance));
    reference += p, mean += r;
    squares += (r - p) * (r - p);
    for (const auto* texel : {&path[i], &radiosity[i]})
      noise += static_cast<double>(texel->value.error) * static_cast<double>(texel->value.error);
  }
  const double n = static_cast<double>(path.size());
  // With 65536 paths a texel the mean agreed to 1.1 %, with a standard error of 0.7 %.
  EXPECT_GT(n, 100);
  EXPECT_NEAR(mean / reference, 1, 0.01 + 3 * std::sqrt(noise) / reference);
  EXPECT_LT(std::sqrt(std::max(0.0, squares - noise) / n), 0.1 * reference / n);
}

}  // namespace
}  // namespace sconce
