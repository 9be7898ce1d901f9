// SPDX-License-Identifier: Apache-2.0
// Closed forms at points, for every row of the solver table; numbers refer to the analytic tests in
// docs/methods.md.
#include <gtest/gtest.h>

#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/solver.h"
#include "solve/test_scenes.h"

namespace sconce {
namespace {

/// A scene ready to be asked at points.
struct Rig : LitScene {
  explicit Rig(Scene s, Grouping grouping = Grouping::per_light) : LitScene(std::move(s), grouping) {}

  std::vector<GroupValue> at(const SolverRow& row, const Vec3& p, const Vec3& n, int samples = 4096,
                             int bounces = -1) const {
    BakeParams params;
    params.samples = samples;
    params.bounces = bounces;
    const auto solver = row.prepare({scene, world, tracer, lamps}, params, {});
    std::vector<GroupValue> values(scene.groups.size());
    solver->solve(Footprint::point(7, ReceiverKind::plane, {p, n, n}), values);
    return values;
  }
};

class EverySolver : public testing::TestWithParam<const SolverRow*> {};
INSTANTIATE_TEST_SUITE_P(Rows, EverySolver, testing::ValuesIn([] {
                           std::vector<const SolverRow*> rows;
                           for (const SolverRow& row : solvers())
                             if (!row.runs_program) rows.push_back(&row);
                           return rows;
                         }()),
                         [](const auto& row) { return std::string(row.param->name); });

// 1. Furnace: radiosity of a closed enclosure with uniform emission e and reflectance r is e / (1 - r);
// illuminance pi L (1 - r^(n+1)) / (1 - r) with n bounces.
TEST_P(EverySolver, Furnace) {
  Scene scene;
  const Rgb rho(0.8f, 0.5f, 0.2f);
  add_box(scene, "walls", add_material(scene, "glow", rho, Rgb(10)), Vec3(-1, -2, -3), Vec3(2, 1, 2), true);
  const Rig rig(std::move(scene));
  for (const int bounces : {0, 1, 3, -1}) {
    const Rgb e = rig.at(*GetParam(), Vec3(0.3f, -2, 0.4f), Vec3(0, 1, 0), 16384, bounces)[0].illuminance;
    const auto expected = [&](double r) {
      return 10 * static_cast<double>(kPi) * (bounces < 0 ? 1 : 1 - std::pow(r, bounces + 1)) / (1 - r);
    };
    EXPECT_NEAR(e.r, expected(0.8), 0.02 * expected(0.8)) << bounces;
    EXPECT_NEAR(e.g, expected(0.5), 0.01 * expected(0.5)) << bounces;
    EXPECT_NEAR(e.b, expected(0.2), 0.01 * expected(0.2)) << bounces;
  }
}

// 2. Inside of a sphere with a point light I at its centre: E = I/R2 + r 4 pi I / (4 pi R2 (1 - r)).
TEST_P(EverySolver, SphereInterior) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.6f)), Vec3(1, 2, 3), 2, 96, true);
  Light light;
  light.name = "bulb";
  light.intensity = Rgb(100);
  light.frame[3] = glm::vec4(1, 2, 3, 1);
  scene.lights.push_back(light);
  const Rig rig(std::move(scene));
  const double expected = 100 / 4.0 + 0.6 * 100 / (4.0 * 0.4);
  EXPECT_NEAR(rig.at(*GetParam(), Vec3(1, 0.001f, 3), Vec3(0, 1, 0), 8192)[0].illuminance.g, expected,
              0.01 * expected);
}

// 9. Lambertian disk, on its axis and parallel at offset r.
TEST_P(EverySolver, Disk) {
  Scene scene;
  add_disk(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(50)), Vec3(0, 2, 0), Vec3(0, -1, 0), 0.75f,
           256);
  const Rig rig(std::move(scene));
  for (const double r : {0.0, 0.5, 1.5, 4.0}) {
    const double z2 = 4, R2 = 0.75 * 0.75, s = z2 + r * r + R2;
    const double expected =
        static_cast<double>(kPi) * 50 / 2 * (1 - (z2 + r * r - R2) / std::sqrt(s * s - 4 * R2 * r * r));
    const auto value = rig.at(*GetParam(), Vec3(r, 0, 0), Vec3(0, 1, 0), 16384)[0];
    EXPECT_NEAR(value.illuminance.g, expected, 0.003 * expected) << "offset " << r;
    EXPECT_LT(value.error, 0.01 * expected);
  }
}

// 10. Lambertian rectangle above a corner-centred receiver.
TEST_P(EverySolver, Rectangle) {
  Scene scene;
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(20)), Vec3(-1, 1.5f, -0.5f), Vec3(2, 0, 0),
           Vec3(0, 0, 1));
  const Rig rig(std::move(scene));
  const double a = 2 / (2 * 1.5), b = 1 / (2 * 1.5);
  const double expected = 4 * 20 / 2.0 *
                          (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                           b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b)));
  EXPECT_NEAR(rig.at(*GetParam(), Vec3(0), Vec3(0, 1, 0), 16384)[0].illuminance.g, expected,
              0.003 * expected);
  EXPECT_EQ(rig.at(*GetParam(), Vec3(0, 3, 0), Vec3(0, -1, 0))[0].illuminance, Rgb()) << "its back is black";
}

// 12. Inverse square and cosine, exactly; sun; range window of KHR_lights_punctual.
TEST_P(EverySolver, PointSpotSun) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "black", Rgb(0)), Vec3(-9, 0, -9), Vec3(0, 0, 18),
           Vec3(18, 0, 0));
  Light light;
  light.name = "a point";
  light.intensity = Rgb(80, 40, 20);
  light.frame[3] = glm::vec4(0, 2, 0, 1);
  scene.lights.push_back(light);
  light.name = "b ranged";
  light.shape = PointLight{4};
  scene.lights.push_back(light);
  light.name = "c spot";
  light.shape = SpotLight{0.3f, 0.6f, 0};
  light.frame =
      Mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 2, 0, 1));
  scene.lights.push_back(light);
  light.name = "d sun";
  light.shape = SunLight{};
  scene.lights.push_back(light);
  const Rig rig(std::move(scene));
  const auto values = rig.at(*GetParam(), Vec3(1, 0, 0), Vec3(0, 1, 0), 64);
  const double e = 80 / 5.0 * 2 / std::sqrt(5.0);
  EXPECT_NEAR(values[0].illuminance.r, e, 1e-5 * e);
  EXPECT_NEAR(values[0].illuminance.b, e / 4, 1e-5 * e);
  EXPECT_NEAR(values[1].illuminance.r, e * (1 - std::pow(5.0, 2) / std::pow(4.0, 4)), 1e-5 * e);
  const double t = (2 / std::sqrt(5.0) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
  EXPECT_NEAR(values[2].illuminance.r, e * t * t, 1e-4 * e);
  EXPECT_NEAR(values[3].illuminance.r, 80, 1e-3);
  EXPECT_EQ(values[0].error, 0) << "one shadow ray at each lamp leaves nothing to chance";
}

TEST_P(EverySolver, ConstantSkyOverOpenGround) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "grey", Rgb(0.5f)), Vec3(-9, 0, -9), Vec3(0, 0, 18),
           Vec3(18, 0, 0));
  add_sky(scene, Rgb(1000, 2000, 3000));
  const Rig rig(std::move(scene));
  const Rgb e = rig.at(*GetParam(), Vec3(0), Vec3(0, 1, 0), 8192)[0].illuminance;
  EXPECT_NEAR(e.r, 1000 * static_cast<double>(kPi), 10);
  EXPECT_NEAR(e.b, 3000 * static_cast<double>(kPi), 30);
}

TEST_P(EverySolver, GroupsSumToTheWholeAtTheSameSeed) {
  const Rig split(coloured_box()), whole(coloured_box(), Grouping::one);
  for (const Vec3 p : {Vec3(0.1f, 0, 0.2f), Vec3(-0.7f, 0, 0.9f)}) {
    const auto parts = split.at(*GetParam(), p, Vec3(0, 1, 0), 256);
    const Rgb sum = parts[0].illuminance + parts[1].illuminance;
    const Rgb all = whole.at(*GetParam(), p, Vec3(0, 1, 0), 256)[0].illuminance;
    EXPECT_NEAR(sum.r, all.r, 1e-6f * all.r);
    EXPECT_NEAR(sum.g, all.g, 1e-6f * all.g);
    EXPECT_NEAR(sum.b, all.b, 1e-6f * all.b);
  }
}

TEST_P(EverySolver, ScalingALampScalesItsLayerExactlyAndLeavesTheOthers) {
  Scene louder = coloured_box();
  louder.materials[2].emission *= 8;
  const Rig before(coloured_box()), after(std::move(louder));
  const auto a = before.at(*GetParam(), Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0), 128);
  const auto b = after.at(*GetParam(), Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0), 128);
  EXPECT_EQ(b[0].illuminance, a[0].illuminance * 8);
  EXPECT_EQ(b[1].illuminance, a[1].illuminance);
}

TEST_P(EverySolver, ColourBleedsFromTheSecondBounceOn) {
  const Rig rig(coloured_box());
  const Vec3 near_red(-0.9f, 0, 0);
  const Rgb direct = rig.at(*GetParam(), near_red, Vec3(0, 1, 0), 8192, 0)[1].illuminance;
  const Rgb once = rig.at(*GetParam(), near_red, Vec3(0, 1, 0), 8192, 1)[1].illuminance;
  EXPECT_NEAR(direct.r / direct.b, 3.0 / 12, 1e-3) << "direct light has the lamp's colour";
  const Rgb bounced = once - direct;
  EXPECT_GT(bounced.r / bounced.b, 1.5 * 3 / 12) << "the first reflection carries the wall's";
}

TEST_P(EverySolver, ErrorIsWhatSeedsScatterOrSomewhatMore) {
  const Rig rig(coloured_box());
  double scatter = 0, stated = 0;
  std::vector<double> values;
  for (uint32_t seed = 0; seed < 24; ++seed) {
    BakeParams params;
    params.samples = 64;
    params.seed = seed;
    params.cloud = 512;
    const auto solver = GetParam()->prepare({rig.scene, rig.world, rig.tracer, rig.lamps}, params, {});
    std::vector<GroupValue> out(rig.scene.groups.size());
    const Vec3 up(0, 1, 0);
    solver->solve(Footprint::point(3, ReceiverKind::plane, {Vec3(0.5f, 0, 0.5f), up, up}), out);
    values.push_back(static_cast<double>(luminance(out[0].illuminance)));
    stated += static_cast<double>(out[0].error) / 24;
  }
  double mean = 0;
  for (const double v : values) mean += v / 24;
  for (const double v : values) scatter += (v - mean) * (v - mean) / 23;
  // Batches that share a sequence spread further than independent ones of their mean's error (ADR 26): seen
  // where single rays are smooth, as those that end on a cache.
  const double most = GetParam()->name == "radiosity" ? 2 : 1.45;
  EXPECT_GT(stated / std::sqrt(scatter), 0.7) << stated << " against " << std::sqrt(scatter);
  EXPECT_LT(stated / std::sqrt(scatter), most) << stated << " against " << std::sqrt(scatter);
}

}  // namespace
}  // namespace sconce
