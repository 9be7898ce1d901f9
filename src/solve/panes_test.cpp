// SPDX-License-Identifier: Apache-2.0
// Closed forms of light through panes.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/photon_map.h"

namespace sconce {
namespace {

const SurfacePoint kFloor{Vec3(0), Vec3(0, 1, 0), Vec3(0, 1, 0)};

/// Two kinds of pane with the same transmittance: nothing but light passed on, of any colour; and holes.
Id<Material> glass(Scene& scene, const Rgb& transmittance) {
  const auto id = add_material(scene, "glass", transmittance);
  scene.materials[id.value].transmission = 1;
  return id;
}
Id<Material> gauze(Scene& scene, float transmittance) {
  const auto id = add_material(scene, "gauze", Rgb(0));
  scene.materials[id.value].alpha_mode = Material::Alpha::blend;
  scene.materials[id.value].alpha = 1 - transmittance;
  return id;
}

void add_bulb(Scene& scene, const Vec3& at, const Rgb& intensity) {
  Light bulb;
  bulb.name = "bulb";
  bulb.intensity = intensity;
  bulb.frame[3] = glm::vec4(at, 1);
  scene.lights.push_back(bulb);
}

/// Panes over a floor; y from 0.5 m up, 10 cm apart.
Scene stack(int panes, const std::function<Id<Material>(Scene&)>& make) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "black", Rgb(0)), Vec3(-50, 0, -50), Vec3(0, 0, 100),
           Vec3(100, 0, 0));
  const auto material = make(scene);
  for (int i = 0; i < panes; ++i)
    add_quad(scene, "pane", material, Vec3(-50, 0.5f + 0.1f * static_cast<float>(i), -50), Vec3(0, 0, 100),
             Vec3(100, 0, 0));
  return scene;
}

/// Mean illuminance at points.
Rgb solve(const LitScene& lit, const std::string& solver, std::vector<SurfacePoint> points,
          int samples = 64) {
  BakeParams params;
  params.samples = samples;
  const auto prepared =
      find_solver(solver).prepare({lit.scene, lit.world, lit.tracer, lit.lamps}, params, {});
  Rgb mean;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<GroupValue> out(lit.scene.groups.size());
    prepared->solve(Footprint::point(static_cast<uint32_t>(i), ReceiverKind::plane, points[i]), out);
    mean += out[0].illuminance / static_cast<float>(points.size());
  }
  return mean;
}

Rgb power(const Rgb& t, int n) {
  return n == 0 ? Rgb(1.0f) : t * power(t, n - 1);
}

void expect_near(const Rgb& found, const Rgb& expected, float relative) {
  EXPECT_NEAR(found.r, expected.r, relative * expected.r);
  EXPECT_NEAR(found.g, expected.g, relative * expected.g);
  EXPECT_NEAR(found.b, expected.b, relative * expected.b);
}

class Panes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Panes, testing::Values("path", "radiosity", "photon"));

// A bulb of 90 cd, 3 m above: E0 = 10 lx; behind n panes t^n E0, to rounding.
TEST_P(Panes, StackBeforeABulb) {
  const Rgb tint(0.9f, 0.5f, 0.25f);
  for (const int n : {0, 1, 2, 5, 12}) {
    Scene coloured = stack(n, [&](Scene& s) { return glass(s, tint); });
    add_bulb(coloured, Vec3(0, 3, 0), Rgb(90));
    expect_near(solve(LitScene(std::move(coloured), Grouping::one), GetParam(), {kFloor}),
                10 * power(tint, n), 1e-5f);
    Scene holes = stack(n, [](Scene& s) { return gauze(s, 0.75f); });
    add_bulb(holes, Vec3(0, 3, 0), Rgb(90));
    expect_near(solve(LitScene(std::move(holes), Grouping::one), GetParam(), {kFloor}),
                Rgb(10 * std::pow(0.75f, static_cast<float>(n))), 1e-5f);
  }
}

// A texel of a lightmap, 10 cm of a floor under a bulb: behind a tinted pane E is its transmittance times
// what it is without.
TEST_P(Panes, ATexelBehindGlass) {
  const Rgb tint(0.8f, 0.5f, 0.2f);
  const auto texel = [&](int panes) {
    Scene scene = stack(panes, [&](Scene& s) { return glass(s, tint); });
    add_bulb(scene, Vec3(0, 3, 0), Rgb(90));
    const LitScene lit(std::move(scene), Grouping::one);
    Footprint footprint = Footprint::point(7, ReceiverKind::texel, kFloor);
    footprint.pieces[0].p1 = Vec3(0, 0, 0.1f), footprint.pieces[0].p2 = Vec3(0.1f, 0, 0);
    footprint.area = 0.005f;
    BakeParams params;
    params.samples = 1024;
    std::vector<GroupValue> out(1);
    find_solver(GetParam())
        .prepare({lit.scene, lit.world, lit.tracer, lit.lamps}, params, {})
        ->solve(footprint, out);
    return out[0].illuminance;
  };
  const Rgb bare = texel(0);
  EXPECT_NEAR(bare.g, 10, 0.03f);  // 90 cd at 3 m, up to 14 cm aside
  expect_near(texel(1), tint * bare, 1e-4f);
}

// An even sky of 1 cd/m2 gives pi lx; panes of 100 m hide all of it but 2 x 0.5 / 50 rad above the horizon.
TEST_P(Panes, StackBeforeTheSky) {
  const Rgb tint(0.9f, 0.5f, 0.25f);
  Scene scene = stack(2, [&](Scene& s) { return glass(s, tint); });
  add_sky(scene, Rgb(1));
  expect_near(solve(LitScene(std::move(scene), Grouping::one), GetParam(), {kFloor}, 4096),
              kPi * power(tint, 2), 0.01f);
}

// A lamp with extent: t^n of what it gives without panes, of which both ways of meeting it have a part.
TEST_P(Panes, StackBeforeAnAreaLamp) {
  const auto lit = [](int panes) {
    Scene scene = stack(panes, [](Scene& s) { return gauze(s, 0.5f); });
    add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(1000)), Vec3(-1, 2, -1), Vec3(2, 0, 0),
             Vec3(0, 0, 2));
    return scene;
  };
  const Rgb bare = solve(LitScene(lit(0), Grouping::one), GetParam(), {kFloor}, 1 << 13);
  const Rgb behind = solve(LitScene(lit(2), Grouping::one), GetParam(), {kFloor}, 1 << 13);
  EXPECT_NEAR(behind.g / bare.g, 0.25f, 0.01f);
}

// A bulb of I within a spherical pane of radius r and transmittance t, within a sphere of radius R and
// reflectance q. Of what the outer sphere reflects a share (r / R)^2 crosses the pane, twice, so that
// E = t I / R^2 + q E (1 - (r / R)^2 (1 - t^2)).
TEST_P(Panes, InASphere) {
  const float q = 0.7f;
  const Rgb t(0.9f, 0.6f, 0.3f);
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(q)), Vec3(0), 2, 64, true);
  add_sphere(scene, "pane", glass(scene, t), Vec3(0), 1, 64, false);
  add_bulb(scene, Vec3(0), Rgb(100));
  const LitScene lit(std::move(scene), Grouping::one);
  std::vector<SurfacePoint> points;
  for (uint32_t i = 0; i < 8; ++i) {
    const Vec3 out = square_to_sphere(sobol_pair(i, 0, 1));
    points.push_back({1.995f * out, -out, -out});
  }
  const Rgb mean = solve(lit, GetParam(), points, 2048);
  const auto closed = [&](float c) { return c * 25 / (1 - q * (0.75f + 0.25f * c * c)); };
  expect_near(mean, {closed(t.r), closed(t.g), closed(t.b)}, 0.02f);
}

// What does not pass is lit: a pane of alpha 1/2 and reflectance q over a black floor. Light that comes
// back from its lower side after none is nothing, so the upper side's own E is that of the bare bulb.
TEST_P(Panes, TheirOwnLight) {
  Scene scene = stack(1, [](Scene& s) {
    const auto id = gauze(s, 0.5f);
    s.materials[id.value].base_color = Rgb(0.8f);
    return id;
  });
  add_bulb(scene, Vec3(0, 3.5f, 0), Rgb(90));
  const SurfacePoint top{Vec3(0, 0.5f, 0), Vec3(0, 1, 0), Vec3(0, 1, 0)};
  expect_near(solve(LitScene(std::move(scene), Grouping::one), GetParam(), {top}), Rgb(10), 1e-3f);
}

// A sphere halved by a white pane of alpha 1/2, a bulb above it. No closed form: below the pane the solvers
// agree.
TEST_P(Panes, ReflectTheRest) {
  const float t = 0.5f, q = 0.8f;
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(q)), Vec3(0), 2, 48, true);
  const auto id = gauze(scene, t);
  scene.materials[id.value].base_color = Rgb(q);
  scene.materials[id.value].double_sided = true;
  add_quad(scene, "pane", id, Vec3(-3, 0, -3), Vec3(0, 0, 6), Vec3(6, 0, 0));
  add_bulb(scene, Vec3(0, 0.5f, 0), Rgb(100));
  const LitScene lit(std::move(scene), Grouping::one);
  const SurfacePoint low{Vec3(0, -1.99f, 0), Vec3(0, 1, 0), Vec3(0, 1, 0)};
  const float reference = solve(lit, "path", {low}, 1 << 14).g;
  EXPECT_GT(reference, t * 100 / (2.5f * 2.5f));
  EXPECT_NEAR(solve(lit, GetParam(), {low}, 4096).g, reference, 0.03f * reference);
}

// All light lands on a pane, half of it goes on.
TEST(PanePhotons, LandOnPanesAndBehind) {
  Scene scene = stack(1, [](Scene& s) { return gauze(s, 0.5f); });
  add_bulb(scene, Vec3(0, 3, 0), Rgb(90));
  const LitScene lit(std::move(scene), Grouping::one);
  const SolveContext context{lit.scene, lit.world, lit.tracer, lit.lamps};
  const PhotonMap map(context, -1, 1 << 20, 1, {});
  const auto light = [&](float y) {
    PhotonMap::Density d;
    map.density({Vec3(0, y, 0), Vec3(0, 1, 0), 400}, d);
    double e = 0;
    for (const auto& [distance2, i] : d.nearest) e += static_cast<double>(map[i].flux.g * d.scale);
    return e;
  };
  EXPECT_NEAR(light(0), 5, 0.5);  // 400 photons scatter by 5 %
  EXPECT_NEAR(light(0.5f), 90 / 6.25, 1.5);
}

// Emission stays opaque, whatever alpha says: lamps are seen by all rays alike.
TEST(PaneMaterials, LampsAreNone) {
  Scene scene;
  const auto lamp = add_material(scene, "lamp", Rgb(0.5f), Rgb(10));
  scene.materials[lamp.value].transmission = 1;
  EXPECT_FALSE(scene.has_panes());
  const auto solid = gauze(scene, 0);
  EXPECT_FALSE(scene.passes(scene[solid]));
  glass(scene, Rgb(1));
  EXPECT_TRUE(scene.has_panes());
}

}  // namespace
}  // namespace sconce
