// SPDX-License-Identifier: Apache-2.0
// Light stays where walls keep it, with every solver: a dark room behind a thin wall is black, and behind a
// door that is nearly closed it is as dark as path tracing says.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/parallel.h"
#include "core/test_data.h"
#include "gather/lit_scene.h"
#include "import/import.h"
#include "scene/shapes.h"
#include "solve/solver.h"

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

// One centimetre of wall; the floor and the ceiling run through.
TEST_P(Leaks, ARoomBehindAThinWallIsBlack) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.8f), {}, true);
  add_quad(scene, "floor", white, Vec3(-3, 0, 0), Vec3(0, 0, 2), Vec3(6, 0, 0));
  add_quad(scene, "ceiling", white, Vec3(-3, 2.5f, 0), Vec3(6, 0, 0), Vec3(0, 0, 2));
  add_quad(scene, "back", white, Vec3(-3, 0, 0), Vec3(6, 0, 0), Vec3(0, 2.5f, 0));
  add_quad(scene, "front", white, Vec3(-3, 0, 2), Vec3(0, 2.5f, 0), Vec3(6, 0, 0));
  add_quad(scene, "left", white, Vec3(-3, 0, 0), Vec3(0, 2.5f, 0), Vec3(0, 0, 2));
  add_quad(scene, "right", white, Vec3(3, 0, 0), Vec3(0, 0, 2), Vec3(0, 2.5f, 0));
  add_box(scene, "wall", white, Vec3(-0.005f, -0.1f, -0.1f), Vec3(0.005f, 2.6f, 2.1f), false);
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(1000)), Vec3(-0.4f, 2.4f, 0.8f),
           Vec3(0.3f, 0, 0), Vec3(0, 0, 0.3f));
  const Rig rig(std::move(scene), 64);
  // Texels across the wall lie in both rooms.
  const auto dark = rig.solve(GetParam().c_str(), 64, 1, [](const Vec3& p) {
    return p.x > 0.2f && p.x < 3.001f && p.y > -0.001f && p.y < 2.501f && p.z > -0.001f && p.z < 2.001f;
  });
  EXPECT_GT(dark.size(), 500u);
  for (const auto& texel : dark)
    ASSERT_EQ(texel.value.illuminance, Rgb())
        << texel.position.x << " " << texel.position.y << " " << texel.position.z;
  const auto lit = rig.solve(GetParam().c_str(), 64, 16,
                             [](const Vec3& p) { return p.x < -0.5f && p.y > -0.001f && p.y < 2.3f; });
  for (const auto& texel : lit) EXPECT_GT(luminance(texel.value.illuminance), 0) << texel.position.x;
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
