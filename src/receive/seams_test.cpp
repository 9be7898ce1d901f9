// SPDX-License-Identifier: Apache-2.0
// What a bilinear look-up sees from both sides of seams, for light that is known.
#include "receive/seams.h"

#include <gtest/gtest.h>

#include "receive/seam_difference.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

/// Light that is smooth in space; per texel its mean over the footprint, and noise of its own on top.
std::vector<Image> layer(TestScene& s, float noise, const std::function<float(const Vec3&)>& light) {
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  const std::size_t texels =
      static_cast<std::size_t>(s.atlas.width) * static_cast<std::size_t>(s.atlas.height);
  std::vector<Image> pages(static_cast<std::size_t>(s.atlas.pages),
                           Image(s.atlas.width, s.atlas.height, {"Y"}));
  std::vector<std::vector<uint8_t>> valid(pages.size(), std::vector<uint8_t>(texels, 0));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Footprint f = receivers.footprint(i);
    float sum = 0;
    for (uint32_t k = 0; k < 16; ++k)
      sum += light(f.sample({(static_cast<float>(k % 4) + 0.5f) / 4, (static_cast<float>(k / 4) + 0.5f) / 4})
                       .position);
    const std::size_t page = receivers.texel(i) / texels, at = receivers.texel(i) % texels;
    const float random = static_cast<float>(i * 2654435761u % 1000) / 500 - 1;
    pages[page].data[at] = sum / 16 * (1 + noise * random);
    valid[page][at] = 1;
  }
  for (std::size_t p = 0; p < pages.size(); ++p) fill_gaps(s.atlas, static_cast<int>(p), valid[p], pages[p]);
  return pages;
}

float falls(const Vec3& p) {
  return 100 * (1 + 0.5f * p.x + 0.3f * p.y * p.y - 0.4f * p.z);
}

TestScene ball_and_tube() {
  TestScene s;
  const auto white = add_material(s.scene, "white", Rgb(0.8f));
  add_sphere(s.scene, "ball", white, Vec3(0, 0.3f, 0), 0.6f, 32, false);
  const auto tube = add_cylinder(s.scene, white, 0.4f, 1.2f, 48);
  s.scene.instances[tube.value].transform[3] = glm::vec4(2, -0.5f, 0, 1);
  s.look({1, 1, 4}, {1, 0, 0});
  s.finish();
  AtlasParams params;
  params.density = 24;
  params.min_density_scale = 1;
  s.unwrap(params);
  return s;
}

TEST(Seams, BothSidesOfASmoothSeamShowTheSame) {
  TestScene s = ball_and_tube();
  const Seams seams(s.world, *s.tracer, s.atlas);
  for (const float noise : {0.0f, 0.1f}) {
    std::vector<Image> pages = layer(s, noise, falls);
    const SeamDifference before = across_seams(s.world, s.atlas, pages);
    seams.close(pages);
    const SeamDifference after = across_seams(s.world, s.atlas, pages);
    ASSERT_GT(before.places.size(), 200u);
    EXPECT_LT(after.rms, before.rms / 12) << noise << ": " << before.rms << " lx";
    EXPECT_LT(after.largest, before.largest / 2) << noise << ": " << before.largest << " lx";
    RecordProperty(noise > 0 ? "noisy" : "smooth",
                   std::to_string(before.rms) + " " + std::to_string(after.rms));
  }
}

TEST(Seams, LinearAndEvenLightStays) {
  TestScene s = ball_and_tube();
  const Seams seams(s.world, *s.tracer, s.atlas);
  std::vector<Image> even = layer(s, 0, [](const Vec3&) { return 7.0f; });
  const std::vector<Image> was = even;
  seams.close(even);
  for (std::size_t i = 0; i < even[0].data.size(); ++i) EXPECT_NEAR(even[0].data[i], was[0].data[i], 1e-5f);
  std::vector<Image> a = layer(s, 0.3f, falls), b = layer(s, 0.2f, [](const Vec3& p) { return p.x + 3; }),
                     sum = a;
  for (std::size_t i = 0; i < sum[0].data.size(); ++i) sum[0].data[i] = 2 * a[0].data[i] + 5 * b[0].data[i];
  for (auto* pages : {&a, &b, &sum}) seams.close(*pages);
  for (std::size_t i = 0; i < sum[0].data.size(); ++i)
    EXPECT_NEAR(sum[0].data[i], 2 * a[0].data[i] + 5 * b[0].data[i], 1e-5f * sum[0].data[i]);
}

/// A floor of two charts, x below and above 0, on a page of 32 x 16, and perhaps a sheet on their seam.
TestScene two_floors(bool wall) {
  TestScene s;
  const auto white = add_material(s.scene, "white", Rgb(0.8f));
  add_quad(s.scene, "floor", white, Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  Mesh& mesh = s.scene.meshes[0];
  mesh.positions = {{-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0, -1}, {1, 0, 1}, {1, 0, -1}};
  mesh.normals.assign(6, Vec3(0, 1, 0));
  mesh.texcoords.clear();
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{1, 4, 5}}, {{1, 5, 2}}};
  if (wall) add_quad(s.scene, "wall", white, Vec3(0, 0, 1), Vec3(0, 0, -2), Vec3(0, 1, 0));
  s.finish();
  s.atlas.width = 32, s.atlas.height = 16, s.atlas.pages = 1;
  s.atlas.front.resize(s.world.size());
  s.atlas.back.resize(s.world.size());
  const Vec2 corners[] = {{2, 2}, {8, 2}, {8, 14}, {2, 14}};
  const auto put = [&](std::size_t t, std::array<std::size_t, 3> c, float x, uint32_t chart) {
    s.atlas.front[t] = {
        {corners[c[0]] + Vec2(x, 0), corners[c[1]] + Vec2(x, 0), corners[c[2]] + Vec2(x, 0)}, 0, chart};
  };
  put(0, {0, 1, 2}, 0, 0), put(1, {0, 2, 3}, 0, 0);
  put(2, {0, 1, 2}, 12, 1), put(3, {0, 2, 3}, 12, 1);
  return s;
}

// Texels of 1/6 m whose rows fit, and a step of light right on the seam: both sides see the same in its
// middle, where no wall makes it what it is.
TEST(Seams, AWallOnTheSeamKeepsLightApart) {
  for (const bool wall : {false, true}) {
    const TestScene s = two_floors(wall);
    std::vector<Image> pages{Image(32, 16, {"Y"})};
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 32; ++x) pages[0].at(x, y)[0] = x < 11 ? 1.0f : 100.0f;
    Seams(s.world, *s.tracer, s.atlas).close(pages);
    for (int y = 3; y < 13; ++y) {
      const float z = static_cast<float>(y) + 0.5f;
      EXPECT_NEAR(look_up(pages[0], {8, z}), wall ? 1 : 50.5f, 99.0f / 512 + 1e-3f) << wall << y;
      EXPECT_NEAR(look_up(pages[0], {14, z}), wall ? 100 : 50.5f, 99.0f / 512 + 1e-3f) << wall << y;
      EXPECT_EQ(pages[0].at(6, y)[0], 1);
      EXPECT_EQ(pages[0].at(15, y)[0], 100);
      EXPECT_EQ(pages[0].at(1, y)[0], 1) << "no seam there";
    }
  }
}

}  // namespace
}  // namespace sconce
