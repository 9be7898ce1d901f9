// SPDX-License-Identifier: Apache-2.0
// Light fields as lamps: samples and particles against the sums that they stand for.
#include "light/near_field.h"

#include <gtest/gtest.h>

#include "core/sobol.h"
#include "light/test_rig.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

/// Some light of every term, brighter towards +x, with dark and (as duals have) negative pixels.
std::shared_ptr<const LightField> uneven(NearBasis basis) {
  LightField f = make_light_field(basis, Vec2(-0.02f, -0.01f), Vec2(0.02f, 0.01f), 0.01, 0.25, 0.2, 16);
  for (std::size_t i = 0; i < f.irradiance.size(); ++i) {
    const auto s = static_cast<float>(i % 16), r = sobol_pair(static_cast<uint32_t>(i), 0, 3).x;
    f.irradiance[i] = r < 0.2f ? -0.3f * r * s : r < 0.4f ? 0 : s * r;
  }
  return std::make_shared<LightField>(std::move(f));
}

struct Rig : LampRig {
  explicit Rig(const std::shared_ptr<const LightField>& field, float exact_below = 1e9f)
      : LampRig(make(field, exact_below)) {}

  static Scene make(const std::shared_ptr<const LightField>& field, float exact_below) {
    Scene scene;
    add_box(scene, "cube", add_material(scene, "dark", Rgb(0)), Vec3(-5), Vec3(5), true);
    scene.luminaires.push_back({"lamp.exr", {}, field});
    for (const float x : {0.0f, 1.0f}) {
      Light light;
      light.name = "lamp";
      light.intensity = Rgb(1, 2, 4);
      light.frame[3] = glm::vec4(x, 0, 0, 1);
      light.shape = LuminaireLight{Id<Luminaire>(0), exact_below};
      scene.lights.push_back(std::move(light));
    }
    return scene;
  }
  const NearFieldLamp& lamp() const { return std::get<NearFieldLamp>(lamps.all()[0].shape); }
  /// Illuminance of a plane across nadir, red lux.
  double lux(const Vec3& x, uint32_t count) const {
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
      LightSample light;
      if (lamps.sample(0, x, sobol_pair(i, 0, 3), light))
        sum += static_cast<double>(light.radiance.r * std::max(0.0f, light.direction.z) / light.pdf);
    }
    return sum / count;
  }
};

const Vec3 kUp(0, 0, 1);

// A mean over samples is eq. 14 where the tolerance is wide, eq. 5 where it is none.
TEST(NearField, SamplesAreTheSumsOfTheirEquations) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const auto field = uneven(basis);
    const NearLamp lamp(*field);
    const Rig approximate(field), exact(field, 0);
    for (const Vec3& x : {Vec3(0.01f, 0, -0.03f), Vec3(0.05f, 0.02f, -0.1f), Vec3(0.1f, -0.1f, -0.4f)}) {
      const double all = lamp.approximate(x, kUp), whole = lamp.exact(x, kUp, 64);
      EXPECT_NEAR(approximate.lux(x, 1 << 14), all, 2e-3 * std::abs(all)) << x.z;
      EXPECT_NEAR(exact.lux(x, 1 << 15), whole, 5e-3 * std::abs(whole)) << x.z;
    }
    EXPECT_EQ(approximate.lux(Vec3(0, 0, 0.1f), 16), 0) << "nothing upwards";
  }
}

// Red, green and blue from patterns of their own: each as the grey light field of that channel, whichever
// equation; particles too.
TEST(NearField, ColoursAreChannelsOfTheirOwn) {
  LightField colored = *uneven(NearBasis::bell);
  const std::size_t size = colored.irradiance.size();
  for (std::size_t i = 0; i < 3 * size;
       ++i)  // blue has no light where red is brightest, some green is negative
    colored.color.push_back(i < size       ? colored.irradiance[i]
                            : i < 2 * size ? sobol_pair(static_cast<uint32_t>(i), 0, 7).x - 0.1f
                                           : 0.2f * std::max(0.0f, 3 - colored.irradiance[i - 2 * size]));
  set_luminance(colored);
  const NearField field(colored);
  ASSERT_EQ(field.channels(), 3u);
  for (const double tolerance : {1e9, 0.0})
    for (const Vec3& x : {Vec3(0.01f, 0, -0.03f), Vec3(0.05f, 0.02f, -0.1f), Vec3(0.1f, -0.1f, -0.4f)}) {
      constexpr uint32_t kCount = 1 << 15;
      glm::dvec3 mean(0);
      for (uint32_t i = 0; i < kCount; ++i) {
        const NearField::Sample s = field.sample(x, sobol_pair(i, 0, 3), tolerance);
        const double cosine =
            static_cast<double>(-x.z) / glm::length(glm::dvec3(s.at, 0) - glm::dvec3(x)) / kCount;
        mean += cosine * glm::dvec3(s.lux.r, s.lux.g, s.lux.b);
      }
      for (int c = 0; c < 3; ++c) {
        const NearLamp lamp(channel_of(colored, c));
        const double truth = tolerance > 0 ? lamp.approximate(x, kUp) : lamp.exact(x, kUp, 64);
        EXPECT_NEAR(mean[c], truth, 0.01 * std::abs(truth)) << c << " " << x.z << " " << tolerance;
      }
    }
  glm::dvec3 sent(0);
  constexpr uint32_t kParticles = 1 << 16;
  for (uint32_t i = 0; i < kParticles; ++i) {
    const EmittedLight e = field.emit(sobol_pair(i, 0, 5), sobol_pair(i, 1, 5));
    sent += glm::dvec3(e.flux.r, e.flux.g, e.flux.b) / double{kParticles};
  }
  for (int c = 0; c < 3; ++c) {
    const double truth = flux(channel_of(colored, c));
    EXPECT_NEAR(sent[c], truth, 0.01 * truth) << c;
  }
  EXPECT_NEAR(static_cast<double>(luminance(field.flux())), flux(colored), 1e-4 * flux(colored));
}

// In between, the bound decides.
TEST(NearField, ToleranceIsHonoured) {
  const auto field = uneven(NearBasis::bell);
  const NearLamp lamp(*field);
  const Vec3 near(0.01f, 0, -0.05f), far(0.01f, 0, -0.5f);
  const double tolerance = 0.5 * (lamp.bound(near, kUp) + lamp.bound(far, kUp));
  ASSERT_LT(lamp.bound(far, kUp), 0.8 * lamp.bound(near, kUp));
  const Rig rig(field, static_cast<float>(tolerance));
  EXPECT_NEAR(rig.lux(near, 1 << 16) / lamp.exact(near, kUp, 16), 1, 4e-3);
  EXPECT_NEAR(rig.lux(far, 1 << 14) / lamp.approximate(far, kUp), 1, 2e-3);
}

// Coarser levels show the same pattern: on both sides of where one takes over, and in the end by a single
// term.
TEST(NearField, PyramidFollowsTheFinest) {
  LightField smooth = make_light_field(NearBasis::bell, Vec2(-0.02f), Vec2(0.02f), 0.01, 0.25, 0.2, 32);
  for (std::size_t term = 0; term < smooth.terms(); ++term)
    for (int i = 0; i < 32 * 32; ++i) {
      const double s = (i % 32 - 15.5) / 16, t = (i / 32 - 11.5) / 16, m = static_cast<double>(term % 7) - 3;
      smooth.irradiance[term * 1024 + static_cast<std::size_t>(i)] =
          static_cast<float>(std::exp(-3 * (s * s + t * t)) * (1 + 0.2 * m));
    }
  const NearField field(smooth);
  const NearLamp finest(smooth);
  std::size_t least = 1000;
  for (double z = 0.2; z < 20; z *= 1.1)
    for (const double tangent : {0.0, 0.1, 0.25}) {
      const Vec3 x(static_cast<float>(z * tangent), 0.01f, static_cast<float>(-z));
      const NearLamp& level = field.level(x);
      least = std::min(least, level.field().terms());
      EXPECT_NEAR(level.approximate(x, kUp) / finest.approximate(x, kUp), 1, 0.01) << z << " " << tangent;
    }
  EXPECT_EQ(least, 1u);
  EXPECT_EQ(field.level(Vec3(0.3f, 0, -0.1f)).field().terms(), smooth.terms());
}

// Flux stated = flux of the images = flux of particles = what lands on a plane below.
TEST(NearField, FluxLandsAsStated) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const auto field = uneven(basis);
    for (const float exact_below : {0.0f, 1e9f}) {
      const Rig rig(field, exact_below);
      const double stated = flux(*field);
      EXPECT_NEAR(rig.lamps.all()[0].flux.r, stated, 1e-5 * stated);
      EXPECT_NEAR(rig.lamps.all()[0].flux.b, 4 * stated, 1e-4 * stated);
      double landed = 0;
      const uint32_t n = 1 << 16;
      const double width = 2;
      for (uint32_t i = 0; i < n; ++i) {
        const Vec2 at = sobol_pair(i, 1, 4);
        LightSample light;
        const Vec3 x(static_cast<float>(width) * (at - 0.5f), -0.5f);
        if (rig.lamps.sample(0, x, sobol_pair(i, 0, 4), light))
          landed += static_cast<double>(light.radiance.r * light.direction.z);
      }
      EXPECT_NEAR(landed * width * width / n / stated, 1, 0.02) << exact_below;
    }
  }
}

// Particles land on the plane cell by cell as rays of eq. 5 do, and carry the flux in the mean.
TEST(NearField, ParticlesLandWhereTheLampShines) {
  const auto field = uneven(NearBasis::bell);
  const Rig rig(field, 0);
  const NearLamp lamp(*field);
  constexpr int kCells = 6;
  const uint32_t n = 1 << 18;
  const double z = 0.15, width = 0.3, cell = width / kCells;
  std::vector<double> got(kCells * kCells);
  double sum = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const EmittedLight e = rig.lamps.emit(0, sobol_pair(i, 0, 5), sobol_pair(i, 1, 5));
    ASSERT_LT(e.direction.z, 0);
    EXPECT_FLOAT_EQ(e.flux.g, 2 * e.flux.r);
    sum += static_cast<double>(e.flux.r);
    const Vec3 p = e.position + e.direction * (static_cast<float>(z) / -e.direction.z);
    const glm::dvec2 at = (glm::dvec2(p.x, p.y) + 0.5 * width) / cell;
    if (at.x >= 0 && at.y >= 0 && at.x < kCells && at.y < kCells)
      got[static_cast<std::size_t>(at.y) * kCells + static_cast<std::size_t>(at.x)] +=
          static_cast<double>(e.flux.r) / n / (cell * cell);
  }
  EXPECT_NEAR(sum / n, flux(*field), 0.01 * flux(*field));
  double brightest = 0;
  for (const double e : got) brightest = std::max(brightest, e);
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      double mean = 0;
      for (int k = 0; k < 16; ++k)
        mean += lamp.exact(Vec3(static_cast<float>((i + (k % 4 + 0.5) / 4) * cell - 0.5 * width),
                                static_cast<float>((j + (k / 4 + 0.5) / 4) * cell - 0.5 * width),
                                static_cast<float>(-z)),
                           kUp, 4) /
                16;
      EXPECT_NEAR(got[static_cast<std::size_t>(j * kCells + i)], mean, 0.03 * brightest) << i << " " << j;
    }
}

TEST(NearField, LampsOfOneLuminaireShareIt) {
  const Rig rig(uneven(NearBasis::bell));
  EXPECT_EQ(rig.lamp().field, std::get<NearFieldLamp>(rig.lamps.all()[1].shape).field);
  float importance[2];
  rig.lamps.importances(Vec3(0, 0, -1), kUp, importance);
  EXPECT_GT(importance[0], 0);
  rig.lamps.importances(Vec3(0, 0, 1), -kUp, importance);
  EXPECT_EQ(importance[0], 0) << "behind the sampling plane it is dark";
}

}  // namespace
}  // namespace sconce
