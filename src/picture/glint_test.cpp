// SPDX-License-Identifier: Apache-2.0
// Light fields on glossy surfaces, against the lobe's own rays that meet the lamp's light field (eq. 5).
#include "picture/glint.h"

#include <gtest/gtest.h>

#include "core/sobol.h"
#include "light/near_field.h"
#include "picture/gloss.h"
#include "picture/test_wall.h"
#include "scene/groups.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

/// A lamp 4 cm across at the origin that shines down onto a place 0.2 m below it.
LightField lamp_field() {
  LightField f = make_light_field(NearBasis::bell, Vec2(-0.02f), Vec2(0.02f), 0.01, 0.25, 0.2, 24);
  for (std::size_t i = 0; i < f.irradiance.size(); ++i) {
    const double s = static_cast<double>(i % 24) - 11.5, t = static_cast<double>(i / 24 % 24) - 11.5;
    f.irradiance[i] = static_cast<float>(100 * std::exp(-(s * s + t * t) / 60));
  }
  return f;
}

struct Rig {
  Scene scene;
  World world;
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<Lamps> lamps;

  explicit Rig(bool shaded) {
    scene.luminaires.push_back({"lamp.exr", {}, std::make_shared<LightField>(lamp_field())});
    Light light;
    light.intensity = Rgb(1, 2, 3);
    light.shape = LuminaireLight{Id<Luminaire>(0), 1e9f};
    scene.lights.push_back(light);
    // A plate, between lamp and place or behind both.
    const float z = shaded ? -0.1f : -1;
    add_box(scene, "plate", add_material(scene, "dark", Rgb(0)), Vec3(-0.2f, -0.2f, z),
            Vec3(0.2f, 0.2f, z + 0.01f), false);
    assign_groups(scene, Grouping::automatic);
    world = make_world(scene);
    tracer = std::make_unique<Tracer>(scene, world);
    lamps = std::make_unique<Lamps>(scene, world);
  }
};

const SurfacePoint kPlace{Vec3(0.01f, 0, -0.2f), Vec3(0, 0, 1), Vec3(0, 0, 1)};

Shade metal(float roughness) {
  Shade out;
  out.base_color = Rgb(0.9f, 0.6f, 0.3f);
  out.metallic = 1, out.roughness = roughness;
  return out;
}

TEST(Glint, IsWhatRaysOfTheLobeMeet) {
  const Rig rig(false);
  const NearLamp lamp(lamp_field());
  ASSERT_EQ(near_lamps(*rig.lamps), std::vector<std::size_t>{0});
  for (const float roughness : {0.5f, 0.8f})
    for (const float slant : {0.0f, 0.3f}) {
      const Vec3 to_eye = glm::normalize(Vec3(slant, 0.1f, 1));
      constexpr uint32_t kCount = 1 << 15;
      double met = 0, ours = 0;
      for (uint32_t i = 0; i < kCount; ++i) {
        const Vec2 u = sobol_pair(i, 0, 4);
        const Gloss g = gloss(metal(roughness), to_eye, kPlace, u);
        if (g.direction.z > 0) {
          const glm::dvec3 x(kPlace.position), d(g.direction);
          const glm::dvec2 uv = glm::dvec2(x) + glm::dvec2(d) * (-x.z / d.z),
                           st = uv + (glm::dvec2(x) - uv) * (0.25 / -x.z);
          met += static_cast<double>(g.mirrored.g) * lamp.radiance(uv, st) / kCount;
        }
        ours +=
            static_cast<double>(glint(*rig.lamps, 0, *rig.tracer, metal(roughness), to_eye, kPlace, u).g) /
            kCount;
      }
      EXPECT_NEAR(ours / (2 * met), 1, 0.03) << roughness << " " << slant << ": " << met;
    }
}

TEST(Glint, HasItsShadow) {
  const Rig rig(true);
  for (uint32_t i = 0; i < 64; ++i)
    EXPECT_TRUE(glint(*rig.lamps, 0, *rig.tracer, metal(0.5f), Vec3(0, 0, 1), kPlace, sobol_pair(i, 0, 1))
                    .is_black());
}

// A mirror's lobe is as wide as half a filter: finite light, and none beside it.
TEST(Glint, MirrorsStayFinite) {
  const Rig rig(false);
  double straight = 0, beside = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const Vec2 u = sobol_pair(i, 0, 1);
    straight += static_cast<double>(glint(*rig.lamps, 0, *rig.tracer, metal(0), Vec3(0, 0, 1), kPlace, u).g);
    beside += static_cast<double>(
        glint(*rig.lamps, 0, *rig.tracer, metal(0), glm::normalize(Vec3(1, 0, 1)), kPlace, u).g);
  }
  EXPECT_TRUE(std::isfinite(straight));
  EXPECT_LT(beside, 0.01 * straight);
}

// In a picture: as bright as the fader, nothing where reflections are not asked for.
TEST_F(Picture, LightFieldsGlintUnderTheirFader) {
  PackageContents c = constant(0);
  c.scene.materials[0].metallic = 1, c.scene.materials[0].roughness = 0.5f;
  c.scene.luminaires.push_back({"lamp.exr", {}, std::make_shared<LightField>(lamp_field())});
  c.scene.luminaires.back().photometry.azimuths = {0};
  c.scene.luminaires.back().photometry.polars = {0, 90};
  c.scene.luminaires.back().photometry.candela = {1, 0};
  Light light;
  light.name = "near", light.intensity = Rgb(1);
  light.group = Id<LightGroup>(0), light.group_name = c.scene.groups.at(0).name;
  light.frame[3] = glm::vec4(0, 0, 0.3f, 1);
  light.shape = LuminaireLight{Id<Luminaire>(0), 1e9f};
  c.scene.lights.push_back(light);
  const auto mean = [&](float weight) {
    double sum = 0;
    for (const float v : render(c, weight).data) sum += static_cast<double>(v);
    return sum;
  };
  EXPECT_EQ(mean(1), 0);
  reflections_ = 2;
  const double one = mean(1);
  EXPECT_GT(one, 0);
  EXPECT_NEAR(mean(2), 2 * one, 1e-5 * one);
  EXPECT_EQ(mean(0), 0);
}

}  // namespace
}  // namespace sconce
