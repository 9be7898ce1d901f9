// SPDX-License-Identifier: Apache-2.0
// Indirect light for a renderer that is known, against closed forms; numbers refer to the analytic tests in
// docs/methods.md.
#include "detect/realtime.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "detect/test_rig.h"

namespace sconce {
namespace {

/// A ball of reflectance 0.7 with a lamp in its middle, made once.
class InABall : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = std::make_unique<Rig>(ball(), std::vector<SyntheticMaterial>{{{Rgb(), Rgb(), Rgb(0.7f)}}},
                                 std::vector<SyntheticLamp>{});
  }
  static void TearDownTestSuite() { made.reset(); }
  void SetUp() override {
    rig.host.materials = {{{Rgb(), Rgb(), Rgb(0.7f)}}};
    rig.host.lamps = {{Vec3(0), Rgb(1)}};
    rig.host.unit = 0.7f, rig.host.attenuation = true, rig.host.format = TargetFormat::linear;
    rig.radiosity.set_materials(rig.detection);
  }

  static inline std::unique_ptr<Rig> made;
  Rig& rig = *made;
};

// 33. In a furnace what comes back is emission / (1 - rho): rho emission / (1 - rho) once surfaces show it.
TEST(RealtimeRadiosity, Furnace) {
  const Rgb rho(0.9f, 0.7f, 0.1f), emission(0.2f, 0.3f, 0.4f);
  Rig rig(room(), {{{emission, Rgb(), rho}}}, {});
  EXPECT_EQ(rig.radiosity.uncovered(), 0u);
  ASSERT_TRUE(rig.radiosity.update());
  ASSERT_EQ(rig.radiosity.ambient().size(), rig.world.positions.size());
  for (const Rgb& light : rig.radiosity.ambient()) {
    EXPECT_NEAR(light.r, 0.2f / 0.1f, 0.02f * 2);
    EXPECT_NEAR(light.g, 0.3f / 0.3f, 0.02f * 1);
    EXPECT_NEAR(light.b, 0.4f / 0.9f, 0.02f * 0.44f);
  }
}

// 2. A lamp in the middle of a ball: B = rho E / (1 - rho) is the same everywhere, whatever the renderer
// calls 1.
TEST_F(InABall, LampInTheMiddle) {
  rig.host.lamps = {{Vec3(0), Rgb(2)}};
  for (const float unit : {0.3183f, 1.0f, 2.5f}) {
    rig.host.unit = unit;
    ASSERT_TRUE(rig.radiosity.update());
    EXPECT_NEAR(rig.mean(), static_cast<double>(2 * unit) * 0.7 / 0.3,
                0.03 * static_cast<double>(unit) * 4.7);
  }
}

// A jump of the light: the first frame has all of it, and a frame without light none.
TEST_F(InABall, AnswersAtOnce) {
  rig.host.lamps.clear();
  ASSERT_TRUE(rig.radiosity.update());
  EXPECT_EQ(rig.mean(), 0);
  rig.host.lamps = {{Vec3(0.3f, 0, 0.2f), Rgb(1)}};
  ASSERT_TRUE(rig.radiosity.update());
  const double first = rig.mean();
  for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(rig.radiosity.update());
  EXPECT_EQ(rig.mean(), first);
  EXPECT_GT(first, 0.97 * 0.7 * 0.7 / 0.3);  // E averages I x 4 pi / (4 pi), from any place in the ball
  rig.host.lamps.clear();
  ASSERT_TRUE(rig.radiosity.update());
  EXPECT_EQ(rig.mean(), 0);
}

// Within a budget: the right energy in every frame, and the whole answer as soon as light has rested.
TEST_F(InABall, RefinesWhileLightRests) {
  const auto frame = [&](const Vec3& lamp, const FrameBudget& budget) {
    rig.host.lamps = {{lamp, Rgb(1)}};
    const FrameReport report = rig.radiosity.update(budget);
    EXPECT_TRUE(report);
    return report.coarse;
  };
  const auto answer = [&] {
    return std::vector<Rgb>(rig.radiosity.ambient().begin(), rig.radiosity.ambient().end());
  };
  const FrameBudget cluster{64};
  for (const Vec3 lamp : {Vec3(-0.4f, 0.2f, 0), Vec3(0, -0.5f, 0.3f), Vec3(0)}) {
    frame(lamp, {});
    const double mean = rig.mean();
    const std::vector<Rgb> whole = answer();
    frame(-lamp + Vec3(0.1f), {});
    std::size_t left = whole.size();
    for (std::size_t frames = 1; left > 0; ++frames) {
      const std::size_t coarse = frame(lamp, cluster);
      ASSERT_EQ(coarse, std::max(rig.radiosity.transfer().gather.rows, 64 * static_cast<uint32_t>(frames)) -
                            64 * frames);
      left = coarse;
      EXPECT_NEAR(rig.mean() / mean, 1, 1e-4) << frames;
      EXPECT_EQ(answer() == whole, left == 0);
    }
  }
  // Out of the dark, and without any time.
  rig.host.lamps.clear();
  ASSERT_TRUE(rig.radiosity.update());
  frame(Vec3(0), {.milliseconds = 0});
  EXPECT_NEAR(rig.mean(), 0.7 * 0.7 / 0.3, 0.05);
}

// 33. Another light model changes what is captured, and with that the answer; nothing is made again.
TEST_F(InABall, FollowsTheRenderersShaders) {
  ASSERT_TRUE(rig.radiosity.update());
  const double before = rig.mean();
  rig.host.unit *= 3;
  ASSERT_TRUE(rig.radiosity.update());
  EXPECT_NEAR(rig.mean() / before, 3, 1e-4);
  rig.host.lamps[0].position = Vec3(0, 0.5f, 0);
  ASSERT_TRUE(rig.radiosity.update());
  const double near = rig.mean();
  rig.host.attenuation = false;
  ASSERT_TRUE(rig.radiosity.update());
  EXPECT_LT(rig.mean(), 0.99 * near);
}

// Around a hollow ball of glass, a quarter of what the shell sees: light passes it twice, I = g emission /
// (1 - g rho) with g = 3/4 + 1/4 tau^2, of each colour by its own tau.
TEST(RealtimeRadiosity, LightGoesThrough) {
  Scene scene = ball();
  add_sphere(scene, "glass", add_material(scene, "glass", Rgb(0)), Vec3(0), 0.5f, 16, false);
  for (const Rgb& tau : {Rgb(0), Rgb(0.8f), Rgb(0.9f, 0.5f, 0)}) {
    Rig rig(scene, {{{Rgb(1), Rgb(), Rgb(0.5f)}}, {{Rgb(), tau, Rgb()}}}, {});
    ASSERT_TRUE(rig.radiosity.update());
    const std::size_t shell = rig.scene.meshes[0].positions.size();
    Rgb mean;
    for (std::size_t v = 0; v < shell; ++v) mean += rig.radiosity.ambient()[v] / static_cast<float>(shell);
    const auto expected = [](float t) { return (0.75f + 0.25f * t * t) / (0.625f - 0.125f * t * t); };
    EXPECT_NEAR(mean.r, expected(tau.r), 0.025f * expected(tau.r)) << tau.r;
    EXPECT_NEAR(mean.g, expected(tau.g), 0.025f * expected(tau.g)) << tau.g;
    EXPECT_NEAR(mean.b, expected(tau.b), 0.025f * expected(tau.b)) << tau.b;
  }
}

// A ball of frosted glass with a lamp in it, in a shell: all light is even, so that with what leaves surfaces
//   inner = rho lamp + rho (inner + tau shell),  outer = rho shell,
//   shell = rho_s (3/4 shell + 1/4 (outer + tau (inner + tau shell))).
// Without its back the glass would be dark, and all else with it.
TEST(RealtimeRadiosity, BothSidesOfWhatLetsLightThrough) {
  Scene scene;  // fine, since shading normals make more of a coarse ball's light
  add_sphere(scene, "shell", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), 1, 32, true);
  add_sphere(scene, "glass", add_material(scene, "glass", Rgb(0)), Vec3(0), 0.5f, 32, false);
  const float tau = 0.5f, rho = 0.4f, rho_s = 0.6f;
  Rig rig(scene, {{{Rgb(), Rgb(), Rgb(rho_s)}}, {.response = {Rgb(), Rgb(tau), Rgb(rho)}, .two_sided = true}},
          {{Vec3(0), Rgb(0.5f)}});
  EXPECT_TRUE(rig.detection.materials[1].two_sided);
  EXPECT_EQ(rig.radiosity.uncovered(), 0u);
  const FrameReport report = rig.radiosity.update();
  ASSERT_TRUE(report);
  EXPECT_EQ(report.capture.draws, 2u);
  const double lamp = static_cast<double>(rig.host.unit * rho) * 0.5 / 0.25;
  const double t = static_cast<double>(tau), r = static_cast<double>(rho), s = static_cast<double>(rho_s);
  // inner = (lamp + r t shell) / (1 - r)
  const double a = lamp / (1 - r), b = r * t / (1 - r);
  const double shell = s * 0.25 * t * a / (1 - s * (0.75 + 0.25 * (r + t * (b + t))));
  const std::size_t of_shell = rig.scene.meshes[0].positions.size();
  double sum = 0;
  for (std::size_t v = 0; v < of_shell; ++v) sum += static_cast<double>(rig.radiosity.ambient()[v].g);
  EXPECT_NEAR(sum / static_cast<double>(of_shell), shell / s, 0.03 * shell / s);
}

// The same glass of a renderer that lights fronts only.
TEST(RealtimeRadiosity, BacksThatTheRendererDoesNotLight) {
  Scene scene = ball();
  add_sphere(scene, "glass", add_material(scene, "glass", Rgb(0)), Vec3(0), 0.5f, 8, false);
  Rig rig(scene, {{{Rgb(), Rgb(), Rgb(0.6f)}}, {{Rgb(), Rgb(0.5f), Rgb(0.4f)}}}, {{Vec3(0), Rgb(0.5f)}});
  EXPECT_FALSE(rig.detection.materials[1].two_sided);
  const FrameReport report = rig.radiosity.update();
  ASSERT_TRUE(report);
  EXPECT_EQ(report.capture.draws, 2u) << "what is dark is drawn again, on white";
  EXPECT_EQ(rig.mean(), 0);
}

// Darker paint, found by looking again.
TEST_F(InABall, MaterialsMayChange) {
  rig.host.materials[0].response.reflectance = Rgb(0.3f);
  rig.radiosity.set_materials(detect_materials(rig.scene, rig.world, rig.host.renderer()));
  ASSERT_TRUE(rig.radiosity.update());
  EXPECT_NEAR(rig.mean(), 0.7 * 0.3 / 0.7, 0.01);
}

// A dark screen between the lamp and a part of the ball moves aside: the light is that of a ball that had it
// there from the start. Until its rows are made, the old ones answer.
TEST(RealtimeRadiosity, ThingsMove) {
  Scene scene = ball();
  add_box(scene, "screen", add_material(scene, "dark", Rgb(0.1f)), Vec3(0.2f, -0.4f, -0.4f),
          Vec3(0.3f, 0.4f, 0.4f), false);
  TransferParams params = quick();
  params.movable = true;
  const std::vector<SyntheticMaterial> materials{{{Rgb(), Rgb(), Rgb(0.7f)}}, {{Rgb(), Rgb(), Rgb(0.1f)}}};
  const std::vector<SyntheticLamp> lamps{{Vec3(0), Rgb(1)}};
  Rig rig(scene, materials, lamps, params);
  ASSERT_TRUE(rig.radiosity.update());
  const std::vector<Rgb> before(rig.radiosity.ambient().begin(), rig.radiosity.ambient().end());

  for (Instance& instance : scene.instances)
    if (instance.name == "screen") instance.transform[3] = {-0.6f, 0.3f, 0, 1};
  Rig right(scene, materials, lamps);
  ASSERT_TRUE(right.radiosity.update());
  EXPECT_THROW(right.radiosity.follow(), UsageError);
  rig.scene = scene, rig.world = make_world(rig.scene), rig.tracer = Tracer(rig.scene, rig.world);
  rig.radiosity.follow();
  EXPECT_TRUE(rig.radiosity.following());
  rig.radiosity.wait();
  const FrameReport report = rig.radiosity.update();
  ASSERT_TRUE(report);
  EXPECT_FALSE(report.following);
  double off = 0, was_off = 0, sum = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const float light = right.radiosity.ambient()[v].g;
    off += static_cast<double>(std::abs(rig.radiosity.ambient()[v].g - light));
    was_off += static_cast<double>(std::abs(before[v].g - light));
    sum += static_cast<double>(light);
  }
  EXPECT_LT(off / sum, 0.03) << was_off / sum;
  EXPECT_GT(was_off / sum, 0.06);
  EXPECT_NEAR(rig.mean() / right.mean(), 1, 0.01);
}

TEST(RealtimeRadiosity, LightmapTexels) {
  const Scene scene = room();
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const TracedScene traced{scene, world, tracer};
  AtlasParams size;
  size.page_size = 64;
  const Atlas atlas = make_atlas(scene, world, tracer, size);
  const Rgb rho(0.6f), emission(0.5f);
  SyntheticHost host{world, {{{emission, Rgb(), rho}}}};
  const Detection detection = detect_materials(scene, world, host.renderer());
  RealtimeRadiosity radiosity(traced, texel_receivers(traced, atlas), atlas_space(atlas), host.renderer(),
                              detection, quick());
  ASSERT_TRUE(radiosity.update());
  EXPECT_EQ(radiosity.uncovered(), 0u);
  ASSERT_EQ(radiosity.ambient().size(), 64u * 64u);
  std::size_t lit = 0;
  for (const Rgb& light : radiosity.ambient())
    if (light.g > 0) {
      ++lit;
      EXPECT_NEAR(light.g, 0.5f / 0.4f, 0.025f);
    }
  EXPECT_GT(lit, radiosity.transfer().gather.rows) << "texels around receivers";
}

TEST_F(InABall, GoesOnWithoutABadRenderer) {
  ASSERT_TRUE(rig.radiosity.update());
  rig.host.lamps[0].intensity = Rgb(NAN);
  const FrameReport report = rig.radiosity.update();
  EXPECT_NE(report.fault.find("the renderer's drawing of direct light: has the value nan"),
            std::string::npos);
  EXPECT_EQ(rig.mean(), 0);
  rig.host.lamps[0].intensity = Rgb(1);
  EXPECT_TRUE(rig.radiosity.update());
  EXPECT_GT(rig.mean(), 1);
  rig.host.format = TargetFormat::srgb8;
  EXPECT_NE(rig.radiosity.update().fault.find("floats (allowed:"), std::string::npos);
}

}  // namespace
}  // namespace sconce
