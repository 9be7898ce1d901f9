// SPDX-License-Identifier: Apache-2.0
// The basis sh1 at points, for every solver that knows directions: closed forms first.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/solver.h"
#include "solve/test_scenes.h"

namespace sconce {
namespace {

/// One group's answer.
struct Directional {
  GroupValue e;
  std::array<Vec3, 3> g;  ///< per channel
};

class Sh1 : public testing::TestWithParam<const SolverRow*> {
 protected:
  static std::vector<GroupValue> values(const LitScene& lit, Basis basis, const SurfacePoint& at,
                                        int samples = 1024) {
    BakeParams params;
    params.samples = samples;
    params.basis = basis;
    params.cloud = 512;
    params.photons = 1 << 14;
    const auto solver = GetParam()->prepare({lit.scene, lit.world, lit.tracer, lit.lamps}, params, {});
    std::vector<GroupValue> out(lit.scene.groups.size() * coefficients(basis));
    solver->solve(Footprint::point(7, ReceiverKind::plane, at), out);
    return out;
  }
  static std::vector<Directional> solve(const LitScene& lit, const Vec3& p, const Vec3& n,
                                        int samples = 1024) {
    const std::vector<GroupValue> all = values(lit, Basis::sh1, {p, n, n}, samples);
    const std::size_t groups = lit.scene.groups.size();
    std::vector<Directional> result;
    for (std::size_t g = 0; g < groups; ++g) {
      Directional d{all[g], {}};
      for (int axis = 0; axis < 3; ++axis) {
        const Rgb& c = all[static_cast<std::size_t>(axis + 1) * groups + g].illuminance;
        d.g[0][axis] = c.r, d.g[1][axis] = c.g, d.g[2][axis] = c.b;
      }
      result.push_back(d);
    }
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(Rows, Sh1, testing::ValuesIn([] {
                           std::vector<const SolverRow*> rows;
                           for (const SolverRow& row : solvers())
                             if (!row.runs_program) rows.push_back(&row);
                           return rows;
                         }()),
                         [](const auto& row) { return std::string(row.param->name); });

void expect_near(const Vec3& v, const Vec3& expected, float tolerance) {
  EXPECT_NEAR(v.x, expected.x, tolerance);
  EXPECT_NEAR(v.y, expected.y, tolerance);
  EXPECT_NEAR(v.z, expected.z, tolerance);
}

Scene black_floor() {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "black", Rgb(0)), Vec3(-9, 0, -9), Vec3(0, 0, 18),
           Vec3(18, 0, 0));
  return scene;
}

void add_sun(Scene& scene, const Vec3& from, const Rgb& lux) {
  Light sun;
  sun.name = "sun";
  sun.intensity = lux;
  sun.shape = SunLight{};
  const Vec3 z = glm::normalize(from), x = glm::normalize(glm::cross(Vec3(0.3f, 1, 0.2f), z));
  sun.frame = Mat4(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(0, 0, 0, 1));
  scene.lights.push_back(sun);
}

// All light from d: g = I d / 2, whatever the receiver's normal is.
TEST_P(Sh1, DistantLight) {
  const Vec3 d = glm::normalize(Vec3(3, 1, -2));
  Scene scene = black_floor();
  add_sun(scene, d, Rgb(100, 50, 25));
  const LitScene lit(std::move(scene), Grouping::per_light);
  for (const Vec3 n : {Vec3(0, 1, 0), glm::normalize(Vec3(0.3f, 1, 0.1f)), d}) {
    const Directional v = solve(lit, Vec3(0, 0.01f, 0), n, 8)[0];
    EXPECT_NEAR(v.e.illuminance.r, 100 * glm::dot(n, d), 1e-3f);
    for (std::size_t c = 0; c < 3; ++c) expect_near(v.g[c], d * (50.0f / static_cast<float>(1 << c)), 1e-3f);
  }
}

// A sky of luminance L over black ground: E = pi L, g = pi L n / 2; at a tilted normal the two give what a
// tilted surface gets in truth, pi L (1 + cos) / 2.
TEST_P(Sh1, EvenSky) {
  Scene scene = black_floor();
  add_sky(scene, Rgb(1000, 2000, 3000));
  const LitScene lit(std::move(scene), Grouping::per_light);
  const Vec3 up(0, 1, 0), tilted = glm::normalize(Vec3(1, 1, 0.5f));
  const Directional v = solve(lit, Vec3(0), up, 8192)[0];
  const float e = 1000 * kPi;
  EXPECT_NEAR(v.e.illuminance.r, e, 0.003f * e);
  for (std::size_t c = 0; c < 3; ++c)
    expect_near(v.g[c], up * (0.5f * e * static_cast<float>(c + 1)), 0.005f * e * static_cast<float>(c + 1));
  const float predicted = v.e.illuminance.r + glm::dot(v.g[0], tilted - up);
  const float truth = solve(lit, Vec3(0, 0.01f, 0), tilted, 8192)[0].e.illuminance.r;
  EXPECT_NEAR(truth, e * (1 + tilted.y) / 2, 0.005f * e);
  EXPECT_NEAR(predicted, truth, 0.01f * e);
}

// g . n is half the light that comes in through the plane of n, as E would count it: E / 2.
TEST_P(Sh1, ComponentAlongTheNormalIsHalfOfE) {
  const LitScene lit(coloured_box(), Grouping::per_light);
  for (const Directional& v : solve(lit, Vec3(0.2f, 0, -0.3f), Vec3(0, 1, 0))) {
    EXPECT_NEAR(v.g[0].y, v.e.illuminance.r / 2, 0.005f * v.e.illuminance.r);
    EXPECT_NEAR(v.g[2].y, v.e.illuminance.b / 2, 0.005f * v.e.illuminance.b);
  }
}

TEST_P(Sh1, GroupsAddUp) {
  const LitScene split(coloured_box(), Grouping::per_light), whole(coloured_box(), Grouping::one);
  const auto parts = solve(split, Vec3(-0.7f, 0, 0.9f), Vec3(0, 1, 0), 256);
  const Directional all = solve(whole, Vec3(-0.7f, 0, 0.9f), Vec3(0, 1, 0), 256)[0];
  for (std::size_t c = 0; c < 3; ++c)
    expect_near(parts[0].g[c] + parts[1].g[c], all.g[c], 2e-6f * glm::length(all.g[c]));
}

TEST_P(Sh1, FlatLayerKeepsItsBits) {
  const LitScene lit(coloured_box(), Grouping::per_light);
  const Vec3 face(0, 1, 0);
  const SurfacePoint at{Vec3(0.1f, 0, 0.2f), glm::normalize(Vec3(0.2f, 1, 0)), face};
  const auto flat = values(lit, Basis::flat, at, 256), sh1 = values(lit, Basis::sh1, at, 256);
  for (std::size_t g = 0; g < flat.size(); ++g) {
    EXPECT_EQ(sh1[g].illuminance, flat[g].illuminance);
    EXPECT_EQ(sh1[g].error, flat[g].error);
  }
}

// A turned scene has turned vectors: of lamps exactly, with what walls send back to within noise.
TEST_P(Sh1, TurnsWithTheScene) {
  const Mat3 turn = Mat3(glm::rotate(Mat4(1.0f), 0.7f, glm::normalize(Vec3(1, 2, -1))));
  const auto room = [](const Mat3& r) {
    Scene scene;
    const auto grey = add_material(scene, "grey", Rgb(0.5f));
    add_quad(scene, "floor", grey, r * Vec3(-1, 0, -1), r * Vec3(0, 0, 2), r * Vec3(2, 0, 0));
    add_quad(scene, "wall", grey, r * Vec3(-1, 0, -1), r * Vec3(0, 2, 0), r * Vec3(0, 0, 2));
    Light light;
    light.intensity = Rgb(50);
    light.frame[3] = glm::vec4(r * Vec3(0.6f, 1, 0.1f), 1);
    scene.lights.push_back(light);
    return scene;
  };
  const LitScene plain(room(Mat3(1.0f)), Grouping::per_light), turned(room(turn), Grouping::per_light);
  const Vec3 p(-0.2f, 0, 0.3f), n(0, 1, 0);
  const Directional a = solve(plain, p, n, 8192)[0], b = solve(turned, turn * p, turn * n, 8192)[0];
  expect_near(b.g[0], turn * a.g[0], 0.01f * glm::length(a.g[0]));
  EXPECT_GT(a.g[0].x, 0) << "the lamp is on that side";
}

}  // namespace
}  // namespace sconce
