// SPDX-License-Identifier: Apache-2.0
// Bright meshes in lobes against the lobe integrated over the lamp, and against its rays alone.
#include "picture/highlight.h"

#include <gtest/gtest.h>

#include "core/sobol.h"
#include "picture/gloss.h"
#include "scene/groups.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

constexpr float kHeight = 1, kHalf = 0.05f;  // of a square lamp, m
const SurfacePoint kPlace{Vec3(0), Vec3(0, 0, 1), Vec3(0, 0, 1)};
const Rgb kEmission(1000, 500, 250);

struct Rig {
  Scene scene;
  World world;
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<Lamps> lamps;
  MixSpec mix;

  Rig() {
    const Id<Material> lamp = add_material(scene, "lamp", Rgb(0));
    scene.materials[0].emission = kEmission;
    add_quad(scene, "lamp", lamp, Vec3(0.2f - kHalf, -kHalf, kHeight), Vec3(0, 2 * kHalf, 0),
             Vec3(2 * kHalf, 0, 0));
    assign_groups(scene, Grouping::automatic);
    world = make_world(scene);
    tracer = std::make_unique<Tracer>(scene, world);
    lamps = std::make_unique<Lamps>(scene, world);
    mix.weights.assign(scene.groups.size(), Rgb(2));
  }
};

Shade brass(float roughness) {
  Shade out;
  out.base_color = Rgb(0.9f, 0.6f, 0.3f);
  out.metallic = 1, out.roughness = roughness;
  return out;
}

/// The lobe over the lamp by a fine grid, cd/m2.
double image(const Shade& surface, const Vec3& to_eye) {
  constexpr int kCells = 200;
  double sum = 0;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = [](int i) { return kHalf * (2 * (static_cast<float>(i) + 0.5f) / kCells - 1); };
      const Vec3 to(0.2f + at(x), at(y), kHeight);
      const float d2 = glm::dot(to, to), cell = 4 * kHalf * kHalf / (kCells * kCells);
      const Rgb lobe = gloss_of(surface, to_eye, kPlace, glm::normalize(to), 0);
      sum += static_cast<double>(2 * kEmission.g * lobe.g * cell * kHeight / (d2 * std::sqrt(d2)));
    }
  return sum;
}

TEST(Highlights, BothWaysTogetherAreTheLampsImage) {
  const Rig rig;
  for (const float roughness : {0.1f, 0.3f, 0.7f})
    for (const float slant : {0.2f, -0.3f}) {
      const Vec3 to_eye = glm::normalize(Vec3(slant, 0.1f, 1));
      const Shade surface = brass(roughness);
      const Highlights highlights(*rig.lamps, rig.mix, surface, to_eye, kPlace);
      constexpr uint32_t kCount = 1 << 14;
      double both = 0, squares = 0, met = 0, met_squares = 0;
      for (uint32_t i = 0; i < kCount; ++i) {
        const Gloss g = gloss(surface, to_eye, kPlace, sobol_pair(i, 0, 4));
        const Ray ray{kPlace.position, g.direction};
        const Hit hit = rig.tracer->closest(ray);
        const double by_lobe = hit ? static_cast<double>(2 * kEmission.g * g.mirrored.g) : 0;
        const double one = by_lobe * (hit ? static_cast<double>(highlights.share(ray, hit)) : 0) +
                           static_cast<double>(highlights.pick(*rig.tracer, sobol_pair(i, 0, 5)).g);
        both += one / kCount, squares += one * one / kCount;
        met += by_lobe / kCount, met_squares += by_lobe * by_lobe / kCount;
      }
      const double expected = image(surface, to_eye);
      EXPECT_NEAR(both / expected, 1, 0.01) << roughness << " " << slant << ": " << expected;
      EXPECT_LT(squares - both * both, 0.25 * (met_squares - met * met)) << "less noise than by the lobe";
    }
}

TEST(Highlights, NothingIsPickedThatIsOffOrHidden) {
  Rig rig;
  const Shade surface = brass(0.4f);
  const auto picked = [&] {
    const Highlights highlights(*rig.lamps, rig.mix, surface, Vec3(0, 0, 1), kPlace);
    double sum = 0;
    for (uint32_t i = 0; i < 64; ++i)
      sum += static_cast<double>(highlights.pick(*rig.tracer, sobol_pair(i, 0, 5)).g);
    return sum;
  };
  EXPECT_GT(picked(), 0);
  add_box(rig.scene, "plate", add_material(rig.scene, "dark", Rgb(0)), Vec3(-1, -1, 0.5f), Vec3(1, 1, 0.6f),
          false);
  const World walled = make_world(rig.scene);
  const Tracer behind(rig.scene, walled);
  const Highlights highlights(*rig.lamps, rig.mix, surface, Vec3(0, 0, 1), kPlace);
  EXPECT_TRUE(highlights.pick(behind, Vec2(0.5f)).is_black());
  rig.mix.weights.assign(1, Rgb(0));
  EXPECT_EQ(picked(), 0);
}

}  // namespace
}  // namespace sconce
