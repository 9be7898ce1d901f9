// SPDX-License-Identifier: Apache-2.0
// Particles that leave lamps, against what points see of the same lamps.
#include <gtest/gtest.h>

#include "core/sobol.h"
#include "light/test_rig.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

constexpr uint32_t kParticles = 1 << 18;

/// A dark 2 m cube in the origin (so that bounds are known) and one lamp.
struct Rig : LampRig {
  using LampRig::LampRig;

  template <class F>
  void emit(F&& f) const {
    for (uint32_t i = 0; i < kParticles; ++i) f(lamps.emit(0, sobol_pair(i, 0, 5), sobol_pair(i, 1, 5)));
  }
  /// Mean over particles, lm.
  Rgb flux() const {
    double sum[3] = {0, 0, 0};
    emit([&](const EmittedLight& e) { sum[0] += e.flux.r, sum[1] += e.flux.g, sum[2] += e.flux.b; });
    return Rgb(static_cast<float>(sum[0] / kParticles), static_cast<float>(sum[1] / kParticles),
               static_cast<float>(sum[2] / kParticles));
  }
  /// Illuminance of a disk of radius r at p facing n: what particles bring there, and what sample() says
  /// (mean over the disk), green lux.
  std::pair<double, double> on_patch(const Vec3& p, const Vec3& n, float r) const {
    double brought = 0, seen = 0;
    emit([&](const EmittedLight& e) {
      const float down = -glm::dot(e.direction, n);
      if (down <= 0) return;
      const float t = glm::dot(e.position - p, n) / down;
      const Vec3 at = e.position + t * e.direction - p;
      if (t > 0 && glm::dot(at, at) < r * r) brought += static_cast<double>(e.flux.g * lamps.reach(0, t));
    });
    const Frame frame(n);
    const uint32_t points = 1 << 14;
    for (uint32_t i = 0; i < points; ++i) {
      const Vec3 d = square_to_cosine(sobol_pair(i, 0, 6));
      LightSample light;
      if (lamps.sample(0, p + r * (d.x * frame.x + d.y * frame.y), sobol_pair(i, 1, 6), light))
        seen += static_cast<double>(light.radiance.g / light.pdf) *
                static_cast<double>(std::max(0.0f, glm::dot(light.direction, n)));
    }
    return {brought / kParticles / (kPiD * static_cast<double>(r) * static_cast<double>(r)), seen / points};
  }
};

Scene with_light(Light light) {
  Scene scene;
  add_box(scene, "cube", add_material(scene, "dark", Rgb(0)), Vec3(-1), Vec3(1), true);
  light.name = "lamp";
  light.intensity = Rgb(10, 20, 40);
  scene.lights.push_back(std::move(light));
  return scene;
}

void expect_same(const std::pair<double, double>& e, const char* what) {
  EXPECT_GT(e.second, 0) << what;
  EXPECT_NEAR(e.first, e.second, 0.02 * e.second) << what;
}

TEST(Emit, PointIsUniformOverTheSphere) {
  const Rig rig(with_light({}));
  EXPECT_NEAR(rig.flux().g, 4 * kPiD * 20, 1e-3);
  // Chi-squared over 8 x 16 equal-area cells: 127 degrees of freedom; stratified points stay far below 1 in
  // 1000.
  std::vector<double> cells(128);
  rig.emit([&](const EmittedLight& e) {
    const int z = std::min(7, static_cast<int>((e.direction.z + 1) * 4));
    const int phi =
        std::min(15, static_cast<int>((std::atan2(e.direction.y, e.direction.x) / (2 * kPi) + 0.5f) * 16));
    ++cells[static_cast<std::size_t>(16 * z + phi)];
  });
  double chi2 = 0;
  for (const double n : cells) chi2 += (n - kParticles / 128.0) * (n - kParticles / 128.0) * 128 / kParticles;
  EXPECT_LT(chi2, 181);
}

TEST(Emit, PointWithRange) {
  Light light;
  light.shape = PointLight{2};
  const Rig rig(with_light(light));
  expect_same(rig.on_patch(Vec3(0.3f, 0, -1), Vec3(0, 0, 1), 0.5f), "half way into the range");
}

TEST(Emit, SpotFollowsItsCone) {
  for (const auto& [inner, outer] :
       {std::pair(0.2f, 0.6f), std::pair(0.0f, 0.5f), std::pair(0.5f, 0.5f), std::pair(0.0f, 0.03f)}) {
    Light light;  // shines along -z
    light.shape = SpotLight{inner, outer, 0};
    const Rig rig(with_light(light));
    EXPECT_NEAR(rig.flux().g, rig.lamps.all()[0].flux.g, 1e-4f * rig.lamps.all()[0].flux.g) << outer;
    expect_same(rig.on_patch(Vec3(0, 0, -1), Vec3(0, 0, 1), 0.25f * outer), "middle");
    expect_same(rig.on_patch(Vec3(0.7f * outer, 0, -1), Vec3(0, 0, 1), 0.25f * outer), "edge");
    EXPECT_EQ(rig.on_patch(Vec3(1.6f * outer, 0, -1), Vec3(0, 0, 1), 0.2f * outer).first, 0) << "outside";
  }
}

TEST(Emit, SunIsParallel) {
  Light light;
  light.shape = SunLight{};
  const Rig rig(with_light(light));
  expect_same(rig.on_patch(Vec3(0.2f, 0.1f, 0), Vec3(0, 0, 1), 0.7f), "facing");
  expect_same(rig.on_patch(Vec3(0), glm::normalize(Vec3(1, 0, 2)), 0.7f), "aslant");
}

TEST(Emit, SkyConstantAndImage) {
  Light light;
  light.shape = SkyLight{};
  const Rig constant(with_light(light));
  const auto e = constant.on_patch(Vec3(0), Vec3(0, 1, 0), 1);
  EXPECT_NEAR(e.first, 20 * kPiD, 0.02 * 20 * kPiD);
  SkyLight image;
  image.image = Image::rgb(8, 4);
  for (std::size_t i = 0; i < image.image.data.size(); ++i)
    image.image.data[i] = static_cast<float>(1 + i * i % 7);
  light.shape = image;
  const Rig rig(with_light(light));
  for (const Vec3 n : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)})
    expect_same(rig.on_patch(Vec3(0.1f), n, 0.9f), "image");
  // Through the disk: the integral of radiance over the sphere = 4 x (pi x mean) times the disk's area.
  const double disk = kPiD * 3 * 1.001 * 1.001;
  EXPECT_NEAR(rig.flux().g, 4 * static_cast<double>(rig.lamps.all()[0].flux.g) * disk,
              1e-3 * 4 * static_cast<double>(rig.lamps.all()[0].flux.g) * disk);
}

TEST(Emit, MeshIsLambertianOnItsSides) {
  for (const bool both : {false, true}) {
    Scene scene;
    add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(10, 20, 40), both), Vec3(0),
             Vec3(2, 0, 0), Vec3(0, 1, 0));  // front +z
    const Rig rig(std::move(scene));
    EXPECT_NEAR(rig.flux().b, (both ? 2 : 1) * kPiD * 40 * 2, 1e-2);
    // Moments of a cosine-distributed direction: E[cos] = 2/3, E[cos^2] = 1/2.
    double first = 0, second = 0, front = 0;
    Vec3 mean(0);
    rig.emit([&](const EmittedLight& e) {
      const double c = static_cast<double>(glm::dot(e.direction, e.normal));
      first += c, second += c * c, front += e.normal.z > 0 ? 1 : 0;
      mean += e.position * (1.0f / kParticles);
    });
    EXPECT_NEAR(first / kParticles, 2.0 / 3, 1e-3);
    EXPECT_NEAR(second / kParticles, 0.5, 1e-3);
    EXPECT_NEAR(front / kParticles, both ? 0.5 : 1, 1e-3);
    EXPECT_LT(glm::distance(mean, Vec3(1, 0.5f, 0)), 1e-2f);
    expect_same(rig.on_patch(Vec3(1.5f, 0.5f, 1), Vec3(0, 0, -1), 0.4f), "front");
    if (both) expect_same(rig.on_patch(Vec3(1.5f, 0.5f, -1), Vec3(0, 0, 1), 0.4f), "back");
  }
}

TEST(Emit, TexturedMeshGlowsWhereItsTextureDoes) {
  Scene scene;
  Texture texture;
  texture.pixels.width = 2, texture.pixels.height = 1, texture.pixels.channels = 3;
  texture.pixels.data = {0, 0, 0, 255, 255, 255};  // dark on the left
  texture.nearest = true;
  texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
  scene.textures.push_back(texture);
  const auto material = add_material(scene, "glow", Rgb(0), Rgb(10));
  scene.materials[material.value].emission_texture.texture = Id<Texture>(0);
  add_quad(scene, "lamp", material, Vec3(0), Vec3(2, 0, 0), Vec3(0, 1, 0));
  scene.meshes[0].texcoords = {{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
  const Rig rig(std::move(scene));
  EXPECT_NEAR(rig.flux().g, kPiD * 10, 0.01 * kPiD * 10);
  double left = 0;
  rig.emit([&](const EmittedLight& e) { left += e.position.x < 1 ? static_cast<double>(e.flux.g) : 0; });
  EXPECT_EQ(left, 0);
  expect_same(rig.on_patch(Vec3(1.5f, 0.5f, 0.5f), Vec3(0, 0, -1), 0.3f), "before the bright half");
}

}  // namespace
}  // namespace sconce
