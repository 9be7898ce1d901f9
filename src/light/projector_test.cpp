// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/sobol.h"
#include "light/test_rig.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

constexpr float kYfov = 0.8f, kAspect = 1.5f;

/// At (1, 2, 3), along -z, y up.
LampRig projector(std::shared_ptr<const Image> slide) {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "grey", Rgb(0.5f)), Vec3(-5, 0, -5), Vec3(0, 0, 10),
           Vec3(10, 0, 0));
  Light light;
  light.name = "slide";
  light.intensity = Rgb(100);
  light.frame[3] = glm::vec4(1, 2, 3, 1);
  light.shape = ProjectorLight{std::move(slide), kYfov, kAspect};
  scene.lights.push_back(light);
  return LampRig(std::move(scene));
}

std::shared_ptr<Image> slide(int width, int height, Rgb (*color)(int x, int y)) {
  auto out = std::make_shared<Image>(Image::rgb(width, height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out->set_rgb(x, y, color(x, y));
  return out;
}

/// Illuminance of a screen across the axis, `depth` m away, right and up of it by (x, y) half pictures.
Rgb on_screen(const Lamps& lamps, float depth, Vec2 at) {
  const float half = std::tan(kYfov / 2) * depth;
  LightSample light;
  if (!lamps.sample(0, Vec3(1, 2, 3) + Vec3(at.x * half * kAspect, at.y * half, -depth), Vec2(0), light))
    return {};
  EXPECT_TRUE(light.delta);
  return light.radiance * light.direction.z;
}

// E = I / depth2 all over the picture and nothing beside it.
TEST(Projector, LightsAScreenEvenly) {
  const LampRig rig = projector(slide(3, 2, [](int, int) { return Rgb(1); }));
  for (const float depth : {0.5f, 2.0f})
    for (const Vec2 at : {Vec2(0), Vec2(0.9f, -0.9f), Vec2(-0.99f, 0.99f), Vec2(0.3f, 0.7f)})
      EXPECT_NEAR(on_screen(rig.lamps, depth, at).g, 100 / (depth * depth), 1e-3f / (depth * depth));
  for (const Vec2 at : {Vec2(1.01f, 0), Vec2(0, -1.01f)}) EXPECT_TRUE(on_screen(rig.lamps, 2, at).is_black());
  LightSample behind;
  EXPECT_FALSE(rig.lamps.sample(0, Vec3(1, 2, 4), Vec2(0), behind));
}

TEST(Projector, RowsGoDownAndColumnsRight) {
  const LampRig rig =
      projector(slide(2, 2, [](int x, int y) { return Rgb(x == 0 ? 1.0f : 0.0f, y == 0 ? 1.0f : 0.0f, 0); }));
  const auto expect = [&](Vec2 at, const Rgb& e) {
    const Rgb got = on_screen(rig.lamps, 1, at) / 100;
    EXPECT_NEAR(got.r, e.r, 1e-5) << at.x << " " << at.y;
    EXPECT_NEAR(got.g, e.g, 1e-5) << at.x << " " << at.y;
  };
  expect({-0.8f, 0.8f}, {1, 1, 0});
  expect({0.8f, 0.8f}, {0, 1, 0});
  expect({-0.8f, -0.8f}, {1, 0, 0});
  expect({0, 0.25f}, {0.5f, 0.75f, 0});  // bilinear between middles
}

// The stated flux is I x the picture's mean x its area at 1 m; what leaves is that, and arrives as sample()
// says.
TEST(Projector, FluxAndParticlesAreTheSameLight) {
  const LampRig rig = projector(slide(
      4, 3, [](int x, int y) { return Rgb(x == 1 ? 1.0f : 0.1f, 0.25f * static_cast<float>(y), 0.5f); }));
  const float half = std::tan(kYfov / 2), area = 4 * half * half * kAspect;
  const Rgb flux = rig.lamps.all()[0].flux;
  EXPECT_NEAR(flux.r / (100 * area), 0.325, 1e-5);
  EXPECT_NEAR(flux.g / (100 * area), 0.25, 1e-5);
  EXPECT_NEAR(flux.b / (100 * area), 0.5, 1e-5);
  constexpr uint32_t kParticles = 1 << 16;
  constexpr int kCells = 6;
  Rgb arrived[kCells][kCells] = {}, sum;
  for (uint32_t i = 0; i < kParticles; ++i) {
    const EmittedLight e = rig.lamps.emit(0, Vec2(0), sobol_pair(i, 0, 7));
    EXPECT_EQ(e.position, Vec3(1, 2, 3));
    const Vec2 at = Vec2(e.direction) / (-e.direction.z * Vec2(half * kAspect, half));  // -1 to 1
    const auto cell = [&](float v) {
      return std::clamp(static_cast<int>((v + 1) * 0.5f * kCells), 0, kCells - 1);
    };
    arrived[cell(at.y)][cell(at.x)] += e.flux / static_cast<float>(kParticles);
    sum += e.flux / static_cast<float>(kParticles);
  }
  EXPECT_NEAR(sum.r / flux.r, 1, 2e-3);
  EXPECT_NEAR(sum.g / flux.g, 1, 2e-3);
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      Rgb mean;
      constexpr int kFine = 16;
      for (int i = 0; i < kFine * kFine; ++i) {
        const auto place = [&](int c, int k) {
          return (static_cast<float>(c) + (static_cast<float>(k) + 0.5f) / kFine) * 2 / kCells - 1;
        };
        mean += on_screen(rig.lamps, 1, {place(x, i % kFine), place(y, i / kFine)}) / (kFine * kFine);
      }
      EXPECT_NEAR(arrived[y][x].r, mean.r * area / (kCells * kCells),
                  0.01 * static_cast<double>(flux.r) / (kCells * kCells));
      EXPECT_NEAR(arrived[y][x].g, mean.g * area / (kCells * kCells),
                  0.02 * static_cast<double>(flux.g) / (kCells * kCells));
    }
}

}  // namespace
}  // namespace sconce
