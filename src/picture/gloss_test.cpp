// SPDX-License-Identifier: Apache-2.0
#include "picture/gloss.h"

#include <gtest/gtest.h>

#include "core/sobol.h"

namespace sconce {
namespace {

const SurfacePoint kFloor{Vec3(0), Vec3(0, 1, 0), Vec3(0, 1, 0)};

Vec3 at_angle(float degrees) {
  const float a = degrees * kPi / 180;
  return {std::sin(a), std::cos(a), 0};
}

Shade surface(float metallic, float roughness) {
  Shade out;
  out.base_color = {0.9f, 0.6f, 0.3f};
  out.metallic = metallic;
  out.roughness = roughness;
  return out;
}

TEST(Gloss, SmoothSurfacesMirror) {
  const Gloss part = gloss(surface(1, 0), at_angle(30), kFloor, {0.3f, 0.7f});
  EXPECT_NEAR(glm::distance(part.direction, at_angle(-30)), 0, 1e-6f);
}

// Schlick: F = F0 + (1 - F0)(1 - cos)^5.
TEST(Gloss, FresnelsShare) {
  const Gloss head_on = gloss(surface(1, 0), at_angle(0), kFloor, {0.5f, 0.5f});
  EXPECT_NEAR(head_on.mirrored.r, 0.9f, 1e-6f);
  EXPECT_NEAR(head_on.mirrored.b, 0.3f, 1e-6f);
  const Gloss slanted = gloss(surface(1, 0), at_angle(60), kFloor, {0.5f, 0.5f});
  EXPECT_NEAR(slanted.mirrored.b, 0.3f + 0.7f / 32, 1e-6f);
  for (const float degrees : {0.0f, 60.0f}) {
    const Gloss glazed = gloss(surface(0, 0), at_angle(degrees), kFloor, {0.5f, 0});
    EXPECT_NEAR(glazed.mirrored.r, 0.04f + (degrees > 0 ? 0.96f / 32 : 0), 1e-6f);
    EXPECT_EQ(glazed.mirrored.r, glazed.mirrored.b);
    EXPECT_EQ(glazed.diffuse, 1 - glazed.mirrored.r);
  }
}

TEST(Gloss, RoughDielectricsMirrorNothing) {
  EXPECT_FALSE(mirrors(surface(0, 0.41f)));
  EXPECT_TRUE(mirrors(surface(0, 0.4f)));
  EXPECT_TRUE(mirrors(surface(0.1f, 1)));
  const Gloss half = gloss(surface(0.5f, 1), at_angle(0), kFloor, {0.5f, 0});
  EXPECT_EQ(half.diffuse, 1);
  EXPECT_NEAR(half.mirrored.r, 0.45f, 1e-6f);
}

TEST(Gloss, NothingGoesIntoTheSurface) {
  const SurfacePoint tilted{Vec3(0), glm::normalize(Vec3(0.9f, 1, 0)), Vec3(0, 1, 0)};
  for (uint32_t i = 0; i < 256; ++i)
    for (const float degrees : {-80.0f, 0.0f, 80.0f}) {
      const Gloss part = gloss(surface(1, 0.7f), at_angle(degrees), tilted, sobol_pair(i, 0, 5));
      EXPECT_GE(part.direction.y, 0);
      EXPECT_NEAR(glm::length(part.direction), 1, 1e-5f);
    }
}

// Seen head on, facets steeper than theta are tan^2 / (alpha^2 + tan^2) of what is seen: half beyond tan =
// alpha.
TEST(Gloss, LobeIsThatOfGgx) {
  constexpr uint32_t kCount = 4096;
  for (const float roughness : {0.1f, 0.2f, 0.4f}) {
    const float alpha = roughness * roughness;
    uint32_t steep = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
      const Vec3 mirrored = gloss(surface(1, roughness), at_angle(0), kFloor, sobol_pair(i, 0, 7)).direction;
      const Vec3 facet = glm::normalize(mirrored + at_angle(0));
      steep += std::hypot(facet.x, facet.z) > alpha * facet.y;
    }
    EXPECT_NEAR(static_cast<float>(steep) / kCount, 0.5f, 0.01f) << roughness;
  }
}

// The lobe towards a known direction is the one that gloss() samples: all of it together is 1 for a white
// metal, and its mean direction is the samples'.
TEST(Gloss, TheLobeIsWhatIsSampled) {
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float degrees : {0.0f, 30.0f, 75.0f}) {
      Shade white = surface(1, roughness);
      white.base_color = Rgb(1);
      constexpr uint32_t kCount = 1 << 16;
      double whole = 0;
      glm::dvec3 lobe(0), sampled(0);
      for (uint32_t i = 0; i < kCount; ++i) {
        const Vec2 u = sobol_pair(i, 0, 9);
        const float r = std::sqrt(1 - u.x * u.x), phi = 2 * kPi * u.y;
        const Vec3 direction(r * std::cos(phi), u.x, r * std::sin(phi));
        const double share = 2 * M_PI / kCount *
                             static_cast<double>(gloss_of(white, at_angle(degrees), kFloor, direction, 0).g);
        whole += share, lobe += share * glm::dvec3(direction);
        sampled += glm::dvec3(gloss(white, at_angle(degrees), kFloor, u).direction) / double{kCount};
      }
      EXPECT_NEAR(whole, 1, 0.01) << roughness << " " << degrees;
      EXPECT_NEAR(glm::distance(lobe, sampled), 0, 0.01) << roughness << " " << degrees;
    }
  EXPECT_TRUE(gloss_of(surface(1, 0.5f), at_angle(0), kFloor, Vec3(0, -1, 0), 0).is_black());
}

}  // namespace
}  // namespace sconce
