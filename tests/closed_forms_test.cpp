// SPDX-License-Identifier: Apache-2.0
// Closed forms through the whole path: scene file -> import -> atlas -> bake -> package -> picture of a
// point. Numbers refer to the analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include "bake_job.h"
#include "picture/render.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

constexpr double kPiD = 3.14159265358979323846;

/// A baked scene that can be asked for values.
class Baked {
 public:
  Baked(Scene scene, float density, int samples, int bounces = -1) {
    app::BakeJob job;
    job.scene = folder_.write("scene.glb", write_glb(scene, "test"));
    job.atlas.density = density;
    job.params.samples = samples;
    job.params.bounces = bounces;
    job.encoding = "f32";
    const app::PreparedBake bake(job, {});
    BakeState state = BakeState::create(folder_ / "state", bake.header());
    app::run_bake(bake, {}, state, {});
    manifest_ = app::write_result(bake, std::span(&state, 1), folder_ / "scene.sconce", {}, {});
    package_ = std::make_unique<Package>(Package::open(folder_ / "scene.sconce"));
    view_ = std::make_unique<View>(*package_);
    mix_ = make_mix(manifest_.groups, {}, "", {});
    pages_ = mix_pages(*package_, mix_);
  }

  /// Radiance of the point `target` seen from `eye`, cd/m2.
  Rgb radiance(const Vec3& eye, const Vec3& target) const {
    Camera camera = look_at(eye, target);
    camera.yfov = 0.002f;
    camera.aspect = 1;
    return view_->render(camera, mix_, pages_, {1, 1, 16, 0}).rgb_at(0, 0);
  }
  const GroupInfo& group() const { return manifest_.groups.at(0); }

 private:
  TemporaryFolder folder_;
  Manifest manifest_;
  std::unique_ptr<Package> package_;
  std::unique_ptr<View> view_;
  MixSpec mix_;
  std::vector<Image> pages_;
};

void expect_near(double value, double expected, double relative, const char* what) {
  EXPECT_NEAR(value, expected, relative * expected) << what;
}

TEST(ClosedForms, Furnace) {
  Scene scene;
  add_box(scene, "walls", add_material(scene, "glow", Rgb(0.75f, 0.5f, 0.25f), Rgb(8)), Vec3(0),
          Vec3(1, 2, 1.5f), true);
  const Baked all(scene, 10, 1024);
  const Rgb seen = all.radiance(Vec3(0.5f, 1, 0.7f), Vec3(0.2f, 0, 0.3f));
  expect_near(static_cast<double>(seen.r), 8 / (1 - 0.75), 0.01, "red");
  expect_near(static_cast<double>(seen.g), 8 / (1 - 0.5), 0.01, "green");
  expect_near(static_cast<double>(seen.b), 8 / (1 - 0.25), 0.01, "blue");
  expect_near(all.group().mean_lux, kPiD * 8 * (0.2126 / 0.25 + 0.7152 / 0.5 + 0.0722 / 0.75), 0.005,
              "mean illuminance");
  const Baked two(scene, 10, 1024, 2);
  expect_near(two.group().mean_lux,
              kPiD * 8 * (0.2126 * (1 + 0.75 + 0.5625) + 0.7152 * 1.75 + 0.0722 * (1 + 0.25 + 0.0625)), 0.005,
              "two bounces");
}

TEST(ClosedForms, SphereInteriorWithACentralPoint) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.5f)), Vec3(0), 1.5f, 64, true);
  Light light;
  light.name = "bulb";
  light.intensity = Rgb(90);
  scene.lights.push_back(light);
  const Baked baked(scene, 12, 512);
  const double direct = 90 / 2.25, e = direct + 0.5 * 4 * kPiD * 90 / (4 * kPiD * 2.25 * 0.5);
  expect_near(baked.group().mean_lux, e, 0.01, "mean");
  expect_near(static_cast<double>(baked.radiance(Vec3(0.1f), Vec3(1.49f, 0.1f, 0)).g), 0.5 / kPiD * e, 0.015,
              "at a point");
}

TEST(ClosedForms, ParallelPlates) {
  Scene scene;
  const float r1 = 0.5f, r2 = 0.8f, l1 = 10, l2 = 4, size = 60;
  add_quad(scene, "low", add_material(scene, "low", Rgb(r1), Rgb(l1)), Vec3(-size / 2, 0, -size / 2),
           Vec3(0, 0, size), Vec3(size, 0, 0));
  add_quad(scene, "high", add_material(scene, "high", Rgb(r2), Rgb(l2)), Vec3(-size / 2, 1, -size / 2),
           Vec3(size, 0, 0), Vec3(0, 0, size));
  const Baked baked(scene, 0.5f, 2048);
  const double b1 = static_cast<double>((l1 + r1 * l2) / (1 - r1 * r2));
  expect_near(static_cast<double>(baked.radiance(Vec3(0.2f, 0.9f, 0), Vec3(0)).g), b1, 0.01,
              "radiance of the lower plate");
}

TEST(ClosedForms, FormFactors) {
  for (const bool parallel : {true, false}) {
    Scene scene;
    const auto lamp = add_material(scene, "glow", Rgb(0), Rgb(10)),
               black = add_material(scene, "black", Rgb(0));
    add_quad(scene, "floor", black, Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0));
    if (parallel)
      add_quad(scene, "lamp", lamp, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
    else
      add_quad(scene, "lamp", lamp, Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1));
    const Baked baked(scene, 32, 256);
    // The lamp's own texels see nothing, and have the same area: the mean is half of the floor's.
    expect_near(2 * baked.group().mean_lux, kPiD * 10 * (parallel ? 0.199825 : 0.200044), 0.003,
                parallel ? "parallel" : "at right angles");
  }
}

TEST(ClosedForms, DiskAndRectangle) {
  Scene disk;
  const auto white = [](Scene& s) { return add_material(s, "white", Rgb(0.5f)); };
  add_quad(disk, "floor", white(disk), Vec3(-1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  add_disk(disk, "lamp", add_material(disk, "glow", Rgb(0), Rgb(50)), Vec3(0, 1, 0), Vec3(0, -1, 0), 0.6f,
           96);
  const Baked round(disk, 20, 512, 0);
  const double e = kPiD * 50 * 0.36 / (0.36 + 4);
  expect_near(static_cast<double>(round.radiance(Vec3(0.9f, 0.5f, 0.9f), Vec3(0, -1, 0)).g), 0.5 / kPiD * e,
              0.01, "disk, on its axis");

  Scene panel;
  add_quad(panel, "floor", white(panel), Vec3(-1, 0, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  add_quad(panel, "lamp", add_material(panel, "glow", Rgb(0), Rgb(20)), Vec3(-0.5f, 1, -0.25f), Vec3(1, 0, 0),
           Vec3(0, 0, 0.5f));
  const Baked square(panel, 20, 512, 0);
  const double a = 0.5, b = 0.25;
  const double r = 40 * (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                         b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b)));
  expect_near(static_cast<double>(square.radiance(Vec3(0.9f, 0.5f, 0.9f), Vec3(0, 0, 0)).g), 0.5 / kPiD * r,
              0.01, "rectangle, on its axis");
}

TEST(ClosedForms, InverseSquare) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "white", Rgb(0.5f)), Vec3(-2, 0, -2), Vec3(0, 0, 4),
           Vec3(4, 0, 0));
  Light light;
  light.name = "bulb";
  light.intensity = Rgb(100, 50, 25);
  light.frame[3] = glm::vec4(0, 1.5f, 0, 1);
  scene.lights.push_back(light);
  const Baked baked(scene, 40, 8, 0);
  for (const double x : {0.0, 0.7, 1.5}) {
    const double d2 = x * x + 2.25, e = 100 / d2 * 1.5 / std::sqrt(d2);
    const Rgb seen = baked.radiance(Vec3(0, 1, 0.4f), Vec3(x, 0, 0.0f));
    expect_near(static_cast<double>(seen.r), 0.5 / kPiD * e, 0.003, "red");
    expect_near(static_cast<double>(seen.b), 0.25 * 0.5 / kPiD * e, 0.003, "blue");
  }
  expect_near(baked.group().lumens, 4 * kPiD * (0.2126 * 100 + 0.7152 * 50 + 0.0722 * 25), 1e-5, "lumens");
}

}  // namespace
}  // namespace sconce
