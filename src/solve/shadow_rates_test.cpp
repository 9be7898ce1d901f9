// SPDX-License-Identifier: Apache-2.0
// Shadow rays by need: the mean stays right where few of them decide, and where they go.
#include "solve/shadow_rates.h"

#include <gtest/gtest.h>

#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/path_kernel.h"

namespace sconce {
namespace {

/// Shadow rays cost nothing here but are counted.
struct CountedRays {
  const Tracer& tracer;
  mutable uint32_t shadows = 0;

  Rgb transmittance(const Ray& ray) const {
    ++shadows;
    return tracer.transmittance(ray);
  }
  template <class Random>
  Passage follow(const Ray& ray, Random&& random) const {
    return tracer.follow(ray, random);
  }
};

/// A lamp of 1 x 1 m, 2 m above the floor's origin, and a shutter below that hides it where x < `hidden`.
Scene shuttered(float hidden) {
  Scene scene;
  const auto black = add_material(scene, "black", Rgb(0));
  add_quad(scene, "floor", black, Vec3(-9, 0, -9), Vec3(0, 0, 18), Vec3(18, 0, 0));
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(100)), Vec3(-0.5f, 2, -0.5f), Vec3(1, 0, 0),
           Vec3(0, 0, 1));
  add_quad(scene, "shutter", black, Vec3(-3, 1.999f, -3), Vec3(3 + hidden, 0, 0), Vec3(0, 0, 6));
  return scene;
}

struct Answer {
  double mean = 0;  ///< lux, over receivers
  uint32_t shadows = 0;
};

Answer solve(const LitScene& lit, const Vec3& p, int samples, uint32_t receivers) {
  const std::vector<double> usual = usual_light(lit.world, lit.tracer, lit.lamps);
  const CountedRays rays{lit.tracer};
  BakeParams params;
  params.samples = samples;
  Answer answer;
  std::vector<GroupValue> out(lit.scene.groups.size());
  for (uint32_t i = 0; i < receivers; ++i) {
    PathKernel<CountedRays> kernel(lit.scene, lit.world, rays, lit.lamps, 0, {}, {}, usual);
    const Vec3 up(0, 1, 0);
    solve_receiver(kernel, Footprint::point(i, ReceiverKind::plane, {p, up, up}), params, out);
    answer.mean += static_cast<double>(out[0].illuminance.g) / receivers;
  }
  answer.shadows = rays.shadows;
  return answer;
}

/// E on the axis of a rectangle of which [x0, x1] x [-z, z] is seen from a height h below, by 10 of
/// docs/methods.md: corner rectangles.
double rectangle(double x0, double x1, double z, double h, double radiance) {
  const auto corner = [&](double x) {
    const double a = std::abs(x) / h, b = z / h;
    const double e = radiance / 2 *
                     (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                      b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b)));
    return x < 0 ? -e : e;
  };
  return 2 * (corner(x1) - corner(x0));
}

// Few samples decide for the rest of a receiver: were that to favour what they saw, the mean of many
// receivers would tell.
TEST(ShadowRates, AHalfHiddenLampKeepsItsMean) {
  for (const float hidden : {-0.4f, 0.0f, 0.4f}) {
    const LitScene lit(shuttered(hidden), Grouping::one);
    const double expected = rectangle(static_cast<double>(hidden), 0.5, 0.5, 2, 100);
    for (const int samples : {64, 104})
      EXPECT_NEAR(solve(lit, Vec3(0), samples, 4000).mean, expected, 0.01 * expected)
          << hidden << ", " << samples << " samples";
  }
}

TEST(ShadowRates, FewRaysWhereALampIsSeenEvenlyAndManyAtTheEdgeOfItsShadow) {
  constexpr uint32_t kReceivers = 32;
  constexpr int kSamples = 256;
  const LitScene half(shuttered(0), Grouping::one);
  Scene scene = half.scene;
  scene.instances.pop_back();  // the shutter, and the lamp
  scene.instances.pop_back();
  Light bulb;
  bulb.intensity = Rgb(100);
  bulb.frame[3] = glm::vec4(0, 2, 0, 1);
  scene.lights.push_back(bulb);
  const LitScene open(std::move(scene), Grouping::one);
  EXPECT_LT(solve(open, Vec3(0, 0, 4), 4 * kSamples, kReceivers).shadows, 4 * kReceivers * kSamples / 2);
  EXPECT_GT(solve(half, Vec3(0), kSamples, kReceivers).shadows, kReceivers * kSamples);
  // Far off nobody sees that noise.
  EXPECT_LT(solve(half, Vec3(0, 0, 8), kSamples, kReceivers).shadows, kReceivers * kSamples / 4);
}

TEST(ShadowRates, EveryBatchHasSamplesOfEveryLampAndNoneTwice) {
  for (const uint32_t part : {1u, 2u, 3u, 8u, 13u, 64u}) {
    ShadowRates rates(std::vector<double>(40, 1.0));
    std::vector<uint32_t> next(ShadowRates::kLevels, 0);
    for (uint32_t batch = 0; batch < 8; ++batch) {
      rates.decide(batch * part, part);
      for (std::size_t lamp = 0; lamp < 40; ++lamp) {
        EXPECT_GT(rates.count(rates.level(lamp)), 0u) << part;
        EXPECT_FLOAT_EQ(rates.rate(lamp) * static_cast<float>(part),
                        static_cast<float>(rates.count(rates.level(lamp))));
        // Seen evenly: as few rays as there are levels for.
        for (uint32_t s = 0; s < 16; ++s) rates.note(lamp, 1, 1);
      }
      for (uint32_t level = 0; level < ShadowRates::kLevels; ++level) {
        EXPECT_GE(rates.first(level), next[level]);
        next[level] = rates.first(level) + rates.count(level);
      }
    }
  }
}

// Inside of a sphere with a small lamp at the centre all surfaces get the same.
TEST(ShadowRates, UsualLightIsThatOfLitSurfaces) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.6f)), Vec3(0), 2, 64, true);
  Light light;
  light.intensity = Rgb(100);
  scene.lights.push_back(light);
  const LitScene lit(std::move(scene), Grouping::one);
  const std::vector<double> usual = usual_light(lit.world, lit.tracer, lit.lamps);
  ASSERT_EQ(usual.size(), 1u);
  EXPECT_NEAR(usual[0], 1 / 4.0, 0.01 / 4) << "of 1 cd at 2 m";
}

}  // namespace
}  // namespace sconce
