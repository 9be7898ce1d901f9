// SPDX-License-Identifier: Apache-2.0
// Light fields on glossy surfaces as OpenGL draws them, against their terms by rays; and a picture that is
// kept while its lamp moves.
#include <gtest/gtest.h>

#include "bumpy_room.h"
#include "core/error.h"
#include "core/scratch_folder.h"
#include "core/sobol.h"
#include "gpu/near_lights.h"
#include "gpu/view.h"
#include "package/test_unlit.h"
#include "picture/glint.h"
#include "picture/gloss.h"
#include "picture/render.h"
#include "relight/test_near_spots.h"
#include "scene/groups.h"
#include "spots.h"

namespace sconce {
namespace {

constexpr int kSize = 96, kSide = 512;

/// The room with glossy walls and no light but two light fields', a grey one's and one's in colours.
class NearGlints : public testing::Test {
 protected:
  explicit NearGlints(bool bumpy = false)
      : bumpy_(bumpy),
        package_(unlit(glossy(bumpy), folder_.path())),
        view_(package_),
        scene_(with_lamps(view_.scene())),
        lamps_(scene_, view_.world()) {
    params_.width = params_.height = kSize, params_.samples = 1;
    camera_ = view_.camera("");
    black_.assign(1, Image::rgb(1, 1));
  }

  static Scene glossy(bool bumpy) {
    Scene scene = test::two_lamp_room();
    std::erase_if(scene.instances, [](const Instance& i) { return i.name.starts_with("lamp"); });
    const auto material = [&](const char* name, const Rgb& color, float metallic, float roughness) {
      const auto made = add_material(scene, name, color);
      scene.materials[made.value].metallic = metallic, scene.materials[made.value].roughness = roughness;
      return made;
    };
    for (Instance& i : scene.instances) {
      if (i.name == "floor")
        scene.meshes[i.mesh.value].material = material("tiles", Rgb(0.5f, 0.6f, 0.7f), 0, 0.3f);
      if (i.name == "back")
        scene.meshes[i.mesh.value].material = material("copper", Rgb(0.9f, 0.6f, 0.4f), 1, 0.25f);
      if (i.name == "right wall")
        scene.meshes[i.mesh.value].material = material("paint", Rgb(0.2f, 0.5f, 0.3f), 0.5f, 0.6f);
    }
    if (bumpy) test::add_waves(scene);
    return scene;
  }
  static Scene with_lamps(Scene scene) {
    const auto add = [&](const char* name, const LightField& field, const Vec3& at, const Vec3& aim) {
      scene.luminaires.push_back({name, {}, std::make_shared<LightField>(field)});
      Light light;
      light.name = light.group_name = name;
      light.intensity = Rgb(1, 2, 3);
      light.shape = LuminaireLight{Id<Luminaire>(static_cast<uint32_t>(scene.luminaires.size() - 1)), 1e9f};
      const Frame frame(glm::normalize(at - aim));
      light.frame[0] = glm::vec4(frame.x, 0), light.frame[1] = glm::vec4(frame.y, 0);
      light.frame[2] = glm::vec4(frame.z, 0), light.frame[3] = glm::vec4(at, 1);
      scene.lights.push_back(light);
    };
    add("near", test::spots(), Vec3(-0.2f, 1.6f, 0.2f), Vec3(0.2f, 0.8f, -1));
    add("colored", test::colored_spots(), Vec3(0.3f, 1.5f, 0.5f), Vec3(0, 0, -0.6f));
    assign_groups(scene, Grouping::automatic);
    return scene;
  }

  /// What the coat leaves to what is diffuse, in the mean over the rays of a lobe.
  static float let_through(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at) {
    if (!mirrors(surface)) return 1;
    constexpr uint32_t kRays = 1024;
    double sum = 0;
    for (uint32_t i = 0; i < kRays; ++i)
      sum += static_cast<double>(gloss(surface, to_eye, at, sobol_pair(i, 0, 9)).diffuse);
    return static_cast<float>(sum / kRays);
  }
  /// Per pixel: what it shows of a lamp.
  struct Shown {
    Image diffuse, mirrored, as_if_matt;
  };
  Shown by_rays(std::size_t number) const {
    const auto& lamp = std::get<NearFieldLamp>(lamps_.all()[number].shape);
    const Lens lens(camera_, params_);
    Shown out{Image::rgb(kSize, kSize), Image::rgb(kSize, kSize), Image::rgb(kSize, kSize)};
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const Vec3 direction = lens.direction(Vec2(x, y) + Vec2(0.5f));
        const Hit hit = view_.tracer().closest({lens.eye(), direction});
        if (!hit) continue;
        SurfacePoint at = surface_point(view_.world(), hit), mapped = at;
        mapped.shading_normal += normal_offset(view_.scene(), view_.world(), hit.triangle, hit.barycentric);
        if (!components_.empty()) at = mapped;
        const Shade surface = shade(view_.scene(), view_.world(), hit.triangle, hit.barycentric);
        Rgb e, glints;
        const Rgb one[] = {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1)};
        for (std::size_t c = 0; c < lamp.field->channels(); ++c) {
          const Rgb share = lamp.field->channels() == 1 ? Rgb(1) : one[c];
          e += share * static_cast<float>(near_spots(lamp, at, nullptr, c));
          if (mirrors(surface)) glints += share * near_glints(lamp, surface, -direction, mapped, c);
        }
        out.diffuse.set_rgb(
            x, y,
            let_through(surface, -direction, mapped) * surface.receiver_albedo() * kInvPi * lamp.scale * e);
        out.mirrored.set_rgb(x, y, lamp.scale * glints);
        out.as_if_matt.set_rgb(x, y, surface.base_color * kInvPi * lamp.scale * e);
      }
    return out;
  }
  gpu::NearLights lights(const gpu::View& view, std::size_t number,
                         const gpu::NearLightParams& params) const {
    const std::pair<std::size_t, Rgb> chosen(number, Rgb(1));
    return {context_, view.geometry(), view_.world().bounds, lamps_, {&chosen, 1}, params};
  }
  Image by_opengl(std::size_t number, const gpu::NearLightParams& params) const {
    gpu::View view(context_, view_.shown(), true);
    gpu::NearLights light = lights(view, number, params);
    gpu::AddedLight* added[] = {&light};
    view.draw(camera_, weights_, gpu::MixedPages(context_, black_, components_), params_, {},
              {.added = added});
    return view.linear();
  }
  /// @param share  of values, at least
  void expect_alike(std::size_t lamp, double share) const {
    const auto [matt, glints, plainly] = by_rays(lamp);
    const double all = mean(matt) + mean(glints);
    ASSERT_GT(mean(glints), 0.1 * all);
    const Image device = by_opengl(lamp, {.shadow_side = 0, .glints = true}),
                plain = by_opengl(lamp, {.shadow_side = 0});
    // Hardware filters normal maps in steps of 1/256 texel.
    const double tolerance = context_.capabilities().software || !bumpy_ ? 1e-3 : 1.0 / 64;
    std::size_t alike = 0, without = 0;
    for (std::size_t i = 0; i < device.data.size(); ++i) {
      const auto near = [&](double a, double b) {
        return std::abs(a - b) <= tolerance * std::max(std::abs(b), 0.01 * all);
      };
      const auto m = static_cast<double>(matt.data[i]), g = static_cast<double>(glints.data[i]);
      alike += near(static_cast<double>(device.data[i]), m + g);
      without += near(static_cast<double>(plain.data[i]), static_cast<double>(plainly.data[i]));
    }
    EXPECT_GE(static_cast<double>(alike), share * static_cast<double>(device.data.size())) << lamp;
    EXPECT_GE(static_cast<double>(without), share * static_cast<double>(device.data.size())) << lamp;
  }
  static double mean(const Image& image) {
    double sum = 0;
    for (const float v : image.data)
      sum += std::abs(static_cast<double>(v)) / static_cast<double>(image.data.size());
    return sum;
  }

  ScratchFolder folder_;
  const bool bumpy_;
  const Package package_;
  const View view_;
  const Scene scene_;
  const Lamps lamps_;
  const gpu::Context context_;
  Camera camera_;
  PictureParams params_;
  std::vector<Image> black_, components_;  ///< of a lightmap that knows directions
  std::vector<Rgb> weights_{2, Rgb(0)};
};

TEST_F(NearGlints, AllTermsAsByRays) {
  for (const std::size_t lamp : {0, 1}) expect_alike(lamp, 0.995);
}

class BumpyGlints : public NearGlints {
 protected:
  BumpyGlints() : NearGlints(true) {}
};

// What is mirrored sees normal maps always, diffuse light where the lightmap's does. All but pixels on edges
// of walls, and those that light or eye graze: packed normals turn by up to 3e-5 there.
TEST_F(BumpyGlints, AllTermsAsByRays) {
  const Image smooth = by_rays(0).as_if_matt;
  expect_alike(0, 0.99);
  components_.assign(3, black_.front());
  EXPECT_GT(std::abs(mean(by_rays(0).as_if_matt) / mean(smooth) - 1), 0.01);
  for (const std::size_t lamp : {0, 1}) expect_alike(lamp, 0.99);
}

// Glints have the shadow that diffuse light has: where all terms are lit, and where none is.
TEST_F(NearGlints, HaveTheirShadows) {
  const auto& lamp = std::get<NearFieldLamp>(lamps_.all()[0].shape);
  const auto [matt, glints, plainly] = by_rays(0);
  const double all = mean(matt) + mean(glints);
  const Image device = by_opengl(0, {.shadow_side = kSide, .glints = true});
  const Lens lens(camera_, params_);
  std::size_t compared = 0, alike = 0, dark = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Hit hit = view_.tracer().closest({lens.eye(), lens.direction(Vec2(x, y) + Vec2(0.5f))});
      if (!hit) continue;
      const SurfacePoint at = surface_point(view_.world(), hit);
      const double open = near_spots(lamp, at, nullptr), seen = near_spots(lamp, at, &view_.tracer());
      if ((seen != open && seen != 0) || near_shadow_edge(lamp, at, view_.tracer(), kSide)) continue;
      const bool shaded = open != 0 && seen == 0;
      const auto want = shaded ? 0.0 : static_cast<double>(matt.rgb_at(x, y).g + glints.rgb_at(x, y).g);
      ++compared;
      dark += shaded && static_cast<double>(glints.rgb_at(x, y).g) > 0.01 * all;
      alike += std::abs(static_cast<double>(device.rgb_at(x, y).g) - want) <=
               1e-3 * std::max(std::abs(want), 0.01 * all);
    }
  EXPECT_GT(dark, 50u) << "some of the shadow lies on what is glossy";
  EXPECT_GT(compared, 6u * kSize * kSize / 10);
  EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(compared)) << "of " << compared;
}

// The picture's own rays pick a term at random, of a coarser light field where that is far away.
TEST_F(NearGlints, AreTheMeanOfThePicturesRays) {
  const auto [matt, glints, plainly] = by_rays(0);
  const auto& lamp = std::get<NearFieldLamp>(lamps_.all()[0].shape);
  const Lens lens(camera_, params_);
  double sum = 0, want = 0;
  for (int y = 0; y < kSize; y += 2)
    for (int x = 0; x < kSize; x += 2) {
      const Vec3 direction = lens.direction(Vec2(x, y) + Vec2(0.5f));
      const Hit hit = view_.tracer().closest({lens.eye(), direction});
      if (!hit) continue;
      const SurfacePoint at = surface_point(view_.world(), hit);
      const Shade surface = shade(view_.scene(), view_.world(), hit.triangle, hit.barycentric);
      if (!mirrors(surface) || near_spots(lamp, at, nullptr) != near_spots(lamp, at, &view_.tracer()))
        continue;
      want += static_cast<double>(glints.rgb_at(x, y).g);
      for (uint32_t i = 0; i < 64; ++i)
        sum += static_cast<double>(glint(lamps_, 0, view_.tracer(), surface, -direction, at,
                                         sobol_pair(i, 0, static_cast<uint32_t>(kSize * y + x)))
                                       .g) /
               64;
    }
  EXPECT_NEAR(sum / want, 1, 0.02);
}

// Lamps that were not chosen shine by their group's weight, and light nothing but what mirrors them.
TEST_F(NearGlints, FollowTheMix) {
  gpu::View view(context_, view_.shown());
  gpu::NearLights light(context_, view.geometry(), view_.world().bounds, lamps_, {},
                        {.shadow_side = 0, .glints = true});
  gpu::AddedLight* added[] = {&light};
  const auto drawn = [&](const std::vector<Rgb>& weights) {
    light.set_mix(weights);
    view.draw(camera_, weights, gpu::MixedPages(context_, black_), params_, {}, {.added = added});
    return view.linear();
  };
  const Image grey = drawn({Rgb(2), Rgb(0)}), colored = drawn({Rgb(0), Rgb(1)}),
              both = drawn({Rgb(2), Rgb(1)});
  const auto [matt, glints, plainly] = by_rays(0);
  EXPECT_NEAR(mean(grey) / mean(glints), 2, 0.01);
  for (std::size_t i = 0; i < both.data.size(); ++i)
    ASSERT_NEAR(both.data[i], grey.data[i] + colored.data[i],
                1e-5 * (1 + std::abs(static_cast<double>(both.data[i]))));
  EXPECT_EQ(mean(drawn({Rgb(0), Rgb(0)})), 0);
}

// The lamp moves under a camera that rests: nothing of the scene but its shadow maps is drawn again.
TEST_F(NearGlints, KeptPicturesAreAsDrawnAnew) {
  const auto& lamp = std::get<NearFieldLamp>(lamps_.all()[0].shape);
  const Vec3 moved = lamp.position + Vec3(0.2f, 0.1f, -0.1f);
  gpu::View kept(context_, view_.shown()), anew(context_, view_.shown());
  gpu::NearLights light = lights(kept, 0, {.glints = true}), other = lights(anew, 0, {.glints = true});
  gpu::AddedLight* added[] = {&light};
  gpu::AddedLight* others[] = {&other};
  const gpu::MixedPages black(context_, black_);
  EXPECT_THROW(kept.relight(added), UsageError);
  kept.draw(camera_, weights_, black, params_, {}, {.added = added, .keep = true});
  const Image before = kept.linear();
  light.move(0, moved, lamp.to_world), other.move(0, moved, lamp.to_world);
  kept.relight(added);
  anew.draw(camera_, weights_, black, params_, {}, {.added = others});
  EXPECT_EQ(kept.linear().data, anew.linear().data);
  EXPECT_NE(kept.linear().data, before.data);
  EXPECT_EQ(light.passes().shadows, 2);
}

}  // namespace
}  // namespace sconce
