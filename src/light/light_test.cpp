// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/sobol.h"
#include "light/spherical_triangle.h"
#include "light/test_rig.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

using Rig = LampRig;

Vec3 on_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(2 * kPi * u.y), z, r * std::sin(2 * kPi * u.y)};
}

Scene with_floor() {
  Scene scene;
  add_quad(scene, "floor", add_material(scene, "grey", Rgb(0.5f)), Vec3(-5, 0, -5), Vec3(0, 0, 10),
           Vec3(10, 0, 0));
  return scene;
}

TEST(AliasTable, PicksInProportionAndNeverAZero) {
  const std::vector<double> weights{1, 0, 3, 6};
  const AliasTable table(weights);
  std::vector<double> count(4);
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    float u = (static_cast<float>(i) + 0.5f) / n;
    ++count[table.sample(u)];
    EXPECT_GE(u, 0);
    EXPECT_LT(u, 1);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(count[i] / n, weights[i] / 10, 1e-4) << i;
}

// Phi = pi L A for one side.
TEST(Lamps, FluxOfMeshes) {
  Scene scene = with_floor();
  add_quad(scene, "panel", add_material(scene, "glow", Rgb(0), Rgb(10, 20, 40)), Vec3(0, 2, 0), Vec3(2, 0, 0),
           Vec3(0, 0, 0.5f));
  add_quad(scene, "both", add_material(scene, "glow both", Rgb(0), Rgb(10), true), Vec3(0, 3, 0),
           Vec3(2, 0, 0), Vec3(0, 0, 0.5f));
  const Rig rig(std::move(scene));
  ASSERT_EQ(rig.lamps.size(), 2u);
  EXPECT_NEAR(rig.lamps.all()[0].flux.b, kPiD * 40, 1e-3);
  EXPECT_NEAR(rig.lamps.all()[1].flux.g, 2 * kPiD * 10, 1e-3);
}

// The stated flux of a spot against the integral of its illuminance over a sphere around it, and its edges.
TEST(Lamps, FluxOfSpots) {
  Scene scene = with_floor();
  Light light;
  light.name = "spot";
  light.intensity = Rgb(100);
  light.shape = SpotLight{0.4f, 0.9f, 0};
  light.frame[3] = glm::vec4(1, 2, 3, 1);
  scene.lights.push_back(light);
  light.name = "hard";
  light.shape = SpotLight{0.5f, 0.5f, 0};
  scene.lights.push_back(light);
  const Rig rig(std::move(scene));
  for (std::size_t lamp = 0; lamp < 2; ++lamp) {
    double sum = 0;
    const uint32_t n = 1 << 16;
    for (uint32_t i = 0; i < n; ++i) {
      LightSample sample;
      const Vec3 out = on_sphere(sobol_pair(i, 0, 1));
      if (rig.lamps.sample(lamp, Vec3(1, 2, 3) + 2.0f * out, Vec2(0), sample)) {
        EXPECT_TRUE(sample.delta);
        sum += static_cast<double>(sample.radiance.g) * 4 * kPiD * 4 / n;
      }
    }
    EXPECT_NEAR(static_cast<double>(rig.lamps.all()[lamp].flux.g) / sum, 1, 0.01) << lamp;
  }
}

// An octant of the sphere: a right angle's solid angle, and the mean of uniform directions, 1/2 on each axis.
// A sliver, seen from a thousand times its width: its area over the distance squared.
TEST(SphericalTriangle, SolidAngleAndUniformDirections) {
  const SphericalTriangle octant(Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 1));
  EXPECT_NEAR(octant.solid_angle(), kPiD / 2, 1e-6);
  const uint32_t n = 1 << 14;
  glm::dvec3 mean(0), squares(0);
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 d(octant.sample(sobol_pair(i, 0, 3)));
    EXPECT_NEAR(glm::length(d), 1, 1e-5);
    EXPECT_GE(std::min({d.x, d.y, d.z}), -1e-5);
    mean += d / double{n}, squares += d * d / double{n};
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0.5, 1e-3) << axis;
    EXPECT_NEAR(squares[axis], 1 / 3.0, 1e-3) << axis;
  }
  const Vec3 far(0, 0, 10);
  const SphericalTriangle sliver(far, far + Vec3(1, 0, 0), far + Vec3(0, 0.01f, 0));
  EXPECT_NEAR(sliver.solid_angle() / (0.005 / 100), 1, 0.02);
}

// A lamp of two triangles close by: the mean of 1/pdf over samples is the solid angle of the square, and
// pdf() says the same of what a ray hits.
TEST(Lamps, NearSquareIsSampledBySolidAngle) {
  Scene scene = with_floor();
  add_quad(scene, "panel", add_material(scene, "glow", Rgb(0), Rgb(10)), Vec3(-1, 1, -1), Vec3(2, 0, 0),
           Vec3(0, 0, 2));
  const Rig rig(std::move(scene));
  // Half a metre from the middle of 2 x 2 m: 4 asin(a^2 / (a^2 + h^2)).
  const Vec3 x(0, 0.5f, 0);
  const double expected = 4 * std::asin(1 / 1.25);
  const auto& mesh = std::get<MeshLamp>(rig.lamps.all()[0].shape);
  for (uint32_t i = 0; i < 64; ++i) {
    LightSample sample;
    ASSERT_TRUE(rig.lamps.sample(0, x, sobol_pair(i, 0, 5), sample));
    EXPECT_NEAR(1 / sample.pdf, expected, 1e-4);
    const Vec3 hit = x + sample.distance * sample.direction;
    EXPECT_NEAR(hit.y, 1, 1e-4);
    EXPECT_LE(std::max(std::abs(hit.x), std::abs(hit.z)), 1 + 1e-4f);
  }
  const Vec3 middle = rig.world.position(mesh.first_triangle, Vec2(1 / 3.0f)) - x;
  EXPECT_NEAR(
      1 / rig.lamps.pdf(mesh.first_triangle, Vec2(1 / 3.0f), glm::length(middle), glm::normalize(middle)),
      expected, 1e-4);
}

// Directions that sample() picks have the density that pdf() states: the mean of 1/pdf over samples is the
// solid angle of the lamp, known here, and pdf() of the point met again is the sample's own.
TEST(Lamps, DensityOfATexturedMesh) {
  Scene scene = with_floor();
  Texture texture;
  texture.name = "stripes";
  texture.pixels = {64, 8, 3, {}};
  for (int i = 0; i < 64 * 8; ++i)
    texture.pixels.data.insert(texture.pixels.data.end(), 3, i % 64 < 8 ? 255 : 10);
  scene.textures.push_back(texture);
  const auto glow = add_material(scene, "glow", Rgb(0), Rgb(10));
  scene.materials[glow.value].emission_texture.texture = Id<Texture>(0);
  const auto panel = add_quad(scene, "panel", glow, Vec3(-1, 2, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  scene.meshes[scene.instances[panel.value].mesh.value].texcoords = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const Rig rig(std::move(scene));
  const auto& mesh = std::get<MeshLamp>(rig.lamps.all()[0].shape);
  EXPECT_GT(mesh.pieces.size(), 100u);
  EXPECT_FALSE(mesh.uniform);
  // A centred square of half width a at distance h: solid angle 4 asin(a2 / (a2 + h2)).
  const double expected = 4 * std::asin(1.0 / (1 + 4));
  const Vec3 x(0);
  double solid_angle = 0, bright = 0, same = 0;
  const uint32_t n = 1 << 14;
  for (uint32_t i = 0; i < n; ++i) {
    LightSample sample;
    ASSERT_TRUE(rig.lamps.sample(0, x, sobol_pair(i, 0, 5), sample));
    solid_angle += 1.0 / static_cast<double>(sample.pdf) / n;
    bright += sample.radiance.g > 5;
    const Vec3 p = x + sample.direction * sample.distance;
    // Which triangle and where: the quad's two triangles share the diagonal from (-1,-1) to (1,1) in (x, z).
    const float s = 0.5f * (p.x + 1), t = 0.5f * (p.z + 1);
    const bool first = s >= t;
    const Vec2 b = first ? Vec2(s - t, t) : Vec2(s, t - s);
    const float again =
        rig.lamps.pdf(mesh.first_triangle + (first ? 0 : 1), b, sample.distance, sample.direction);
    same += std::abs(again / sample.pdf - 1) < 1e-3f;
  }
  EXPECT_NEAR(solid_angle, expected, 0.02 * expected);
  EXPECT_GT(same / n, 0.99) << "only points on a piece's border may fall to either side";
  EXPECT_GT(bright / n, 0.6) << "the bright eighth gets most samples";
}

TEST(Lamps, DensityOfALatLongSky) {
  Scene scene = with_floor();
  Light light;
  light.name = "sky";
  light.intensity = Rgb(1);
  SkyLight sky;
  sky.image = Image::rgb(32, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) sky.image.set_rgb(x, y, Rgb(x == 20 && y == 5 ? 1000.0f : 1.0f));
  light.shape = sky;
  scene.lights.push_back(light);
  const Rig rig(std::move(scene));
  // Over the sphere the density integrates to 1, and sampling estimates the mean radiance with little noise.
  double total = 0, direct = 0, sampled = 0, same = 0;
  const uint32_t n = 1 << 16;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 d = on_sphere(sobol_pair(i, 0, 3));
    total += static_cast<double>(rig.lamps.sky_pdf(0, d)) * 4 * kPiD / n;
    direct += static_cast<double>(rig.lamps.sky_radiance(0, d).g) * 4 * kPiD / n;
    LightSample sample;
    ASSERT_TRUE(rig.lamps.sample(0, Vec3(0), sobol_pair(i, 1, 3), sample));
    sampled += static_cast<double>(sample.radiance.g / sample.pdf) / n;
    same += std::abs(rig.lamps.sky_pdf(0, sample.direction) / sample.pdf - 1) < 1e-3f;
  }
  EXPECT_NEAR(total, 1, 0.01);
  EXPECT_GT(same / n, 0.99) << "only directions on a pixel's border may fall to either side";
  EXPECT_NEAR(sampled / direct, 1, 0.02);
  EXPECT_NEAR(static_cast<double>(rig.lamps.all()[0].flux.g), sampled / 4, 0.02 * sampled / 4)
      << "pi x mean radiance";
}

TEST(Lamps, ImportanceIsNeverZeroWhereLightArrivesAndKnowsNoStrength) {
  Scene scene = with_floor();
  add_quad(scene, "a panel", add_material(scene, "glow", Rgb(0), Rgb(10)), Vec3(-1, 2, -1), Vec3(2, 0, 0),
           Vec3(0, 0, 1.5f));
  add_sphere(scene, "b globe", add_material(scene, "globe", Rgb(0), Rgb(5)), Vec3(2, 1, 0), 0.3f, 8, false);
  Scene strong = scene;
  for (Material& m : strong.materials) m.emission *= 1000;
  const Rig rig(std::move(scene)), louder(std::move(strong));
  for (uint32_t i = 0; i < 4096; ++i) {
    const Vec2 a = sobol_pair(i, 0, 1), b = sobol_pair(i, 1, 1), c = sobol_pair(i, 2, 1);
    const Vec3 x(8 * a.x - 4, 4 * a.y, 8 * b.x - 4), n = on_sphere(c);
    std::vector<float> importances(2), again(2);
    rig.lamps.importances(x, n, importances);
    louder.lamps.importances(x, n, again);
    EXPECT_EQ(importances, again);
    for (std::size_t lamp = 0; lamp < 2; ++lamp) {
      const float importance = importances[lamp];
      LightSample sample;
      const bool arrives =
          rig.lamps.sample(lamp, x, sobol_pair(i, 3, 1), sample) && glm::dot(sample.direction, n) > 1e-3f;
      EXPECT_TRUE(!arrives || importance > 0);
    }
  }
}

TEST(Lamps, ColourOfAGroup) {
  Scene scene = with_floor();
  const auto red = add_quad(scene, "red", add_material(scene, "red", Rgb(0), Rgb(10, 0, 0)), Vec3(0, 2, 0),
                            Vec3(1, 0, 0), Vec3(0, 0, 1));
  const auto blue = add_quad(scene, "blue", add_material(scene, "blue", Rgb(0), Rgb(0, 0, 10)), Vec3(2, 2, 0),
                             Vec3(1, 0, 0), Vec3(0, 0, 1));
  scene.instances[red.value].group_name = scene.instances[blue.value].group_name = "both";
  const Rig rig(std::move(scene));
  const auto groups = group_flux(rig.scene, rig.lamps);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_NEAR(groups[0].lumens, kPiD * 10 * (0.2126 + 0.0722), 1e-3);
  EXPECT_NEAR(luminance(groups[0].color), 1, 1e-5);
  EXPECT_NEAR(groups[0].color.r, groups[0].color.b, 1e-5);
  EXPECT_GT(groups[0].spread, 1);
  EXPECT_EQ(groups[0].lamps.size(), 2u);
}

}  // namespace
}  // namespace sconce
