// SPDX-License-Identifier: Apache-2.0
#include "picture/render.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/test_wall.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TEST_F(Picture, EvenLightOnAnEvenWall) {
  expect_all(render(constant(100)), Rgb(0.5f * kInvPi * 100));
  expect_all(render(constant(100), 0.25f), Rgb(0.5f * kInvPi * 25));
}

// Where no reflection is followed they show what they would mirror of even light: rho/pi E, as in bounces.
TEST_F(Picture, MetalsAreMattWithoutReflections) {
  PackageContents c = constant(100);
  c.scene.materials[0].metallic = 0.75f;
  expect_all(render(c), Rgb(0.5f * kInvPi * 100));
}

TEST_F(Picture, TextureTimesLight) {
  PackageContents c = constant(100);
  Texture red;
  red.pixels = {1, 1, 3, {255, 0, 128}};
  c.scene.textures = {red};
  c.scene.materials[0].base_color_texture.texture = Id<Texture>(0);
  expect_all(render(c), 50 * kInvPi * Rgb(1, 0, srgb_to_linear(128 / 255.0f)));
}

// The layer is linear in x and y, so bilinear look-ups between its texel centres give it back.
TEST_F(Picture, LightmapIsLookedUpBilinearly) {
  const PackageContents c = test_package(1, 1, 8, 8);
  const Image picture = render(c, 1, 64);
  // The camera, 2 m away, sees 4 tan(0.25) = 1.0214 m of the quad's 2 m.
  const float seen = 4 * std::tan(0.25f);
  for (int y = 0; y < 64; y += 9)
    for (int x = 0; x < 64; x += 9) {
      const auto texel = [&](int p) {
        return (0.5f + seen / 2 * ((static_cast<float>(p) + 0.5f) / 64 - 0.5f)) * 8 - 0.5f;
      };
      const float e = 1 + texel(x) / 8 + texel(y) / 16;
      EXPECT_NEAR(picture.rgb_at(x, y).r, 0.5f * kInvPi * e, 2e-4f);
    }
}

TEST_F(Picture, EmittersFollowTheirFaderAndShineFromTheFrontOnly) {
  Material lamp;
  lamp.emission = {10, 20, 4000};
  lamp.base_color = Rgb(0);
  PackageContents c = constant(100);
  add_quad(c, lamp, 1, false);
  Image coverage;
  expect_all(render(c, 0.5f, 16, &coverage), {5, 10, 2000});
  for (const float v : coverage.data) EXPECT_EQ(v, 1);

  PackageContents back = constant(100);
  add_quad(back, lamp, 1, true);
  expect_all(render(back, 0.5f, 16, &coverage), Rgb(0));
  for (const float v : coverage.data) EXPECT_EQ(v, 0);
  lamp.double_sided = true;
  PackageContents both = constant(100);
  add_quad(both, lamp, 1, true);
  expect_all(render(both, 0.5f), {5, 10, 2000});
}

TEST_F(Picture, BacksAreBlack) {
  PackageContents c = constant(100);
  c.scene.meshes[0] = test_quad("quad", Id<Material>(0), 0, true);
  expect_all(render(c), Rgb(0));
  c.scene.materials[0].double_sided = true;
  expect_all(render(c), Rgb(0));
}

// Front and back of a sheet have their own halves of the page: 100 lux above, 10 below with a gradient along
// x.
TEST_F(Picture, TwinIsSeenFromBehind) {
  PackageContents c = test_package(1, 1, 8, 8);
  Image& layer = c.layers[0][0];
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) layer.set_rgb(x, y, y < 4 ? Rgb(100) : Rgb(10 + static_cast<float>(x), 0, 0));
  Material sheet = c.scene.materials[0];
  sheet.double_sided = true;
  c.scene.materials[0] = sheet;
  c.scene.meshes[0] = test_quad("sheet", Id<Material>(0), 0, true);
  c.scene.meshes.push_back(test_quad("sheet", Id<Material>(0), 0, false));
  // The twin's triangles stand in the order of the front's, its corners in another.
  c.scene.meshes[1].triangles = {{{1, 2, 0}}, {{3, 0, 2}}};
  for (Vec2& uv : c.scene.meshes[0].texcoords[1]) uv.y *= 0.5f;
  for (Vec2& uv : c.scene.meshes[1].texcoords[1]) uv.y = 0.75f;
  Instance twin = c.scene.instances[0];
  twin.mesh = Id<Mesh>(1);
  c.scene.instances.push_back(twin);
  c.manifest.instance_pages = {0, 0};
  c.manifest.instance_twins = {1, -1};
  const Package package = write(c);
  const View view(package);
  EXPECT_EQ(view.world().size(), 2u);
  const MixSpec mix{{Rgb(1)}};
  PictureParams params;
  params.width = params.height = 32;
  const std::vector<Image> pages = mix_pages(package, mix);
  const Image behind = view.render(view.camera(""), mix, pages, params);
  const float seen = 4 * std::tan(0.25f);
  for (int x = 0; x < 32; x += 5) {
    const float texel = (0.5f + seen / 2 * ((static_cast<float>(x) + 0.5f) / 32 - 0.5f)) * 8 - 0.5f;
    EXPECT_NEAR(behind.rgb_at(x, 3).r, 0.5f * kInvPi * (10 + texel), 3e-3f);
    EXPECT_EQ(behind.rgb_at(x, 3).g, 0);
  }
  const Image front = view.render(look_at({0, 0.5f, -2}, {0, 0.5f, 0}), mix, pages, params);
  EXPECT_NEAR(front.rgb_at(16, 16).g, 0.5f * kInvPi * 100, 1e-3f);
}

TEST_F(Picture, SkyIsSeenThroughItsFader) {
  PackageContents c = constant(100);
  add_sky(c.scene, Rgb(2, 3, 4), Id<LightGroup>(0));
  const Package package = write(c);
  const View view(package);
  const MixSpec mix{{Rgb(0.5f)}};
  PictureParams params;
  params.width = params.height = 4;
  expect_all(view.render(look_at({0, 0, 2}, {0, 0, 5}), mix, mix_pages(package, mix), params), {1, 1.5f, 2});
}

TEST_F(Picture, SameBitsWithAnyNumberOfThreads) {
  const PackageContents c = test_package(2, 1, 8, 8);
  Image one;
  {
    const ThreadLimit limit(1);
    one = render(c, 1, 70);
  }
  EXPECT_EQ(one.data, render(c, 1, 70).data);
}

TEST_F(Picture, Cameras) {
  PackageContents c = constant(100);
  {
    const Package package = write(c);
    const View view(package);
    EXPECT_EQ(view.camera("main").name, "main");
    EXPECT_EQ(view.camera("").name, "main");
    EXPECT_THROW(view.camera("mane"), UsageError);
  }
  c.scene.cameras.clear();
  const Package package = write(c);
  const View view(package);
  int warnings = 0;
  Progress progress;
  progress.warning = [&](const std::string&) { ++warnings; };
  const Camera camera = view.camera("", progress);
  EXPECT_EQ(warnings, 1);
  EXPECT_NEAR(camera.frame[3].y, -1 + 0.6f * 2, 1e-5f);
  EXPECT_THROW(view.camera("main"), UsageError);
}

TEST_F(Picture, BadRequests) {
  const Package package = write(constant(100));
  const View view(package);
  const MixSpec mix{{Rgb(1)}};
  const std::vector<Image> pages = mix_pages(package, mix);
  PictureParams params;
  params.width = 0;
  EXPECT_THROW(view.render(view.camera(""), mix, pages, params), UsageError);
  params.width = 8;
  params.samples = 0;
  EXPECT_THROW(view.render(view.camera(""), mix, pages, params), UsageError);
  params.samples = 1;
  Camera camera = view.camera("");
  camera.frame[2] = glm::vec4(0);
  EXPECT_THROW(view.render(camera, mix, pages, params), Error);
  EXPECT_THROW(view.render(view.camera(""), {{}}, pages, params), Error);
  EXPECT_THROW(look_at(Vec3(1), Vec3(1)), UsageError);
  std::stop_source stop;
  stop.request_stop();
  Progress progress;
  progress.stop = stop.get_token();
  EXPECT_THROW(view.render(view.camera(""), mix, pages, params, progress), Cancelled);
}

/// A wall facing +z whose normal map turns all normals to (0.6, 0, 0.8); E = 100 lux, g = (-50, 7, 30) lux.
PackageContents bumpy_wall() {
  PackageContents c = directional_test_package(1, 1, 8, 8);
  Texture map;
  map.pixels = {1, 1, 3, {204, 128, 230}};
  c.scene.textures = {map};
  c.scene.materials[0].normal_texture.texture = Id<Texture>(0);
  const float values[] = {100, -50, 7, 30};
  for (std::size_t k = 0; k < 4; ++k)
    for (float& v : c.layers[k][0].data) v = values[k];
  return c;
}

TEST_F(Picture, NormalMapsTurnDirectionalLight) {
  const auto look = [&](const PackageContents& c, bool with) {
    const Package package = write(c);
    const View view(package);
    const MixSpec mix{{Rgb(2, 2, 1)}};
    PictureParams params;
    params.width = params.height = 8;
    EXPECT_EQ(view.sees_normal_maps(), !c.scene.textures.empty() && c.manifest.basis == Basis::sh1);
    return view.render(view.camera(""), mix, mix_pages(package, mix), params, {}, nullptr, {},
                       with ? mix_components(package, mix) : std::vector<Image>{});
  };
  PackageContents c = bumpy_wall();
  const Vec3 n = glm::normalize(2.0f * Vec3(204, 128, 230) / 255.0f - 1.0f);
  const float e = 100 - 50 * n.x + 7 * n.y + 30 * (n.z - 1);
  expect_all(look(c, true), Rgb(2, 2, 1) * (0.5f * kInvPi * e));
  expect_all(look(c, false), Rgb(2, 2, 1) * (0.5f * kInvPi * 100));
  for (float& v : c.layers[1][0].data) v = -500;
  expect_all(look(c, true), Rgb(0));
  c.scene.textures.clear();
  c.scene.materials[0].normal_texture = {};
  expect_all(look(c, true), Rgb(2, 2, 1) * (0.5f * kInvPi * 100));
}

/// Light beside the lightmap's falls on the same normals.
TEST_F(Picture, NormalMapsTurnAddedLight) {
  const Package package = write(bumpy_wall());
  const View view(package);
  const MixSpec mix{{Rgb(0)}};
  PictureParams params;
  params.width = params.height = 4;
  const Vec3 n = glm::normalize(2.0f * Vec3(204, 128, 230) / 255.0f - 1.0f), sun(0.8f, 0, 0.6f);
  const auto look = [&](const std::vector<Image>& components) {
    return view.render(
        view.camera(""), mix, mix_pages(package, mix), params, {}, nullptr,
        [&](const SurfacePoint& at, int, int, uint32_t) { return Rgb(glm::dot(at.shading_normal, sun)); },
        components);
  };
  expect_all(look(mix_components(package, mix)), Rgb(0.5f * kInvPi * glm::dot(n, sun)));
  expect_all(look({}), Rgb(0.5f * kInvPi * sun.z));
}

/// Seen from behind, a double-sided wall's mapped normal is turned round with its own.
TEST_F(Picture, NormalMapsOnBacks) {
  PackageContents c = bumpy_wall();
  c.scene.materials[0].double_sided = true;
  c.scene.meshes.push_back(test_quad("quad", Id<Material>(0), 0, true));
  Instance twin = c.scene.instances[0];
  twin.mesh = Id<Mesh>(1);
  c.scene.instances.push_back(twin);
  c.manifest.instance_pages = {0, 0};
  c.manifest.instance_twins = {1, 0};
  const Package package = write(c);
  const View view(package);
  const MixSpec mix{{Rgb(1)}};
  PictureParams params;
  params.width = params.height = 4;
  const Vec3 n = -glm::normalize(2.0f * Vec3(204, 128, 230) / 255.0f - 1.0f);
  const float e = 100 - 50 * n.x + 7 * n.y + 30 * (n.z + 1);
  expect_all(view.render(look_at({0, 0, -2}, {0, 0, 0}), mix, mix_pages(package, mix), params, {}, nullptr,
                         {}, mix_components(package, mix)),
             Rgb(0.5f * kInvPi * e));
}

Material metal(const Rgb& color, float roughness = 0) {
  Material m;
  m.base_color = color;
  m.metallic = 1;
  m.roughness = roughness;
  return m;
}

/// The grey wall becomes a metal, and another wall of its size stands 5 m before it, behind the camera at 2
/// m.
PackageContents before_metal(const Rgb& color, const Material& other) {
  PackageContents c = constant(100);
  c.scene.materials[0] = metal(color);
  add_quad(c, other, 5, true);
  c.manifest.instance_pages.back() = 0;
  return c;
}

const Rgb kBrass(0.9f, 0.6f, 0.3f);

// The image of a lamp that reaches to x = 1 at z = 5 stands at z = -5: seen from z = 2 it ends at 1/7.
TEST_F(Picture, MirrorShowsTheImageOfALampUnderItsFader) {
  Material lamp;
  lamp.emission = {10, 20, 4000};
  lamp.base_color = Rgb(0);
  const PackageContents c = before_metal(kBrass, lamp);
  reflections_ = 2;
  Image coverage;
  const Image picture = render(c, 0.5f, 64, &coverage);
  for (const float v : coverage.data) EXPECT_EQ(v, 0);
  int lit = 0;
  for (int x = 0; x < 64; ++x) {
    const float tangent = std::tan(0.25f) * ((static_cast<float>(x) + 0.5f) / 32 - 1);
    const Rgb seen = picture.rgb_at(x, 32);
    if (std::abs(std::abs(tangent) - 1 / 7.0f) < std::tan(0.25f) / 32) continue;
    const bool inside = std::abs(tangent) < 1 / 7.0f;
    lit += inside;
    EXPECT_NEAR(seen.r, inside ? 0.9f * 5 : 0, 1e-4f) << x;
    EXPECT_NEAR(seen.b, inside ? 0.3f * 2000 : 0, 5e-2f) << x;
  }
  EXPECT_GT(lit, 30);
}

TEST_F(Picture, MirrorShowsTheMixedLightmapOfAWall) {
  Material wall;
  wall.base_color = {0.8f, 0.4f, 0.2f};
  reflections_ = 2;
  const Image picture = render(before_metal(kBrass, wall), 0.25f, 9);
  const Rgb expected = kBrass * wall.base_color * (kInvPi * 25);
  EXPECT_NEAR(picture.rgb_at(4, 4).r, expected.r, 1e-4f);
  EXPECT_NEAR(picture.rgb_at(4, 4).g, expected.g, 1e-4f);
  EXPECT_NEAR(picture.rgb_at(4, 4).b, expected.b, 1e-4f);
}

// The last mirror in a row shows what it reflects as if it were matt.
TEST_F(Picture, MirrorsInMirrorsEnd) {
  const Rgb steel(0.5f, 0.6f, 0.7f);
  Rgb expected = kBrass * (kInvPi * 100);
  for (reflections_ = 1; reflections_ <= 3; ++reflections_) {
    expected *= reflections_ % 2 == 0 ? kBrass : steel;
    const Rgb seen = render(before_metal(kBrass, metal(steel)), 1, 9).rgb_at(4, 4);
    EXPECT_NEAR(seen.r, expected.r, 1e-4f * expected.r) << reflections_;
    EXPECT_NEAR(seen.b, expected.b, 1e-4f * expected.b) << reflections_;
  }
}

// In a furnace of 1 cd/m2 (pi lux on all surfaces) a metal shows its colour, a white surface 1, however
// rough.
TEST_F(Picture, ReflectionsKeepEnergy) {
  reflections_ = 2;
  for (const float roughness : {0.0f, 0.1f, 0.4f, 0.8f}) {
    PackageContents c = constant(kPi);
    add_sky(c.scene, Rgb(1), Id<LightGroup>(0));
    c.scene.materials[0] = metal(Rgb(1), roughness);
    expect_all(render(c, 1, 8), Rgb(1));
    c.scene.materials[0].metallic = 0;
    expect_all(render(c, 1, 8), Rgb(1));
    if (roughness > 0) continue;  // lobes see facets at a slant: Fresnel's share grows
    c.scene.materials[0] = metal(kBrass, roughness);
    expect_all(render(c, 1, 8), kBrass);
  }
}

TEST_F(Picture, GlossIsTheSameBitsWithAnyNumberOfThreads) {
  PackageContents c = before_metal(kBrass, Material{});
  c.scene.materials[0].roughness = 0.3f;
  reflections_ = 2;
  Image one;
  {
    const ThreadLimit limit(1);
    one = render(c, 1, 70);
  }
  EXPECT_EQ(one.data, render(c, 1, 70).data);
}

}  // namespace
}  // namespace sconce
