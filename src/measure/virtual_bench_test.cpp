// SPDX-License-Identifier: Apache-2.0
#include "measure/virtual_bench.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "light/test_rig.h"
#include "measure/field.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

std::vector<SourceRay> trace(const LampRig& rig, uint64_t rays = 1 << 14) {
  BenchParams params;
  params.rays = rays;
  return trace_luminaire(rig.scene, rig.world, Tracer(rig.scene, rig.world), rig.lamps, params);
}

double flux_of(const std::vector<SourceRay>& rays) {
  double sum = 0;
  for (const SourceRay& ray : rays) sum += static_cast<double>(ray.flux);
  return sum;
}

/// Faces up (+y) from y = 0 with 1 cd/m2 over 2 x 4 m about the origin: 8 pi lm.
Scene upward_emitter() {
  Scene scene;
  add_quad(scene, "emitter", add_material(scene, "light", Rgb(0), Rgb(1)), Vec3(-1, 0, -2), Vec3(0, 0, 4),
           Vec3(2, 0, 0));
  return scene;
}

// A mirror without bounds above a Lambertian emitter sends its light back down as from its image: all of it
// but what meets the emitter again.
TEST(VirtualBench, FlatMirrorShowsTheImage) {
  Scene scene = upward_emitter();
  const Id<Material> mirror = add_material(scene, "mirror", Rgb(0.5f));
  scene.materials[mirror.value].metallic = 1;
  add_quad(scene, "mirror", mirror, Vec3(-500, 3, -500), Vec3(1000, 0, 0), Vec3(0, 0, 1000));
  const auto rays = trace(LampRig(scene));
  double down = 0, cosines = 0;
  for (const SourceRay& ray : rays) {
    ASSERT_LT(ray.direction.z, 0) << "y of the scene is z of the luminaire";
    ASSERT_NEAR(ray.position.z, 3, 1e-2);
    // Traced back to the image, which lies 3 m above the mirror.
    const Vec3 image = ray.position - ray.direction * (3 / -ray.direction.z);
    ASSERT_LE(std::abs(image.x), 1.001f * (1 + 1e-3f * std::abs(ray.position.x)));
    ASSERT_LE(std::abs(image.y), 2.001f * (1 + 1e-3f * std::abs(ray.position.y))) << "z of the scene is -y";
    down += static_cast<double>(ray.flux);
    cosines += static_cast<double>(ray.flux * -ray.direction.z);
  }
  // Parallel rectangles 2 x 4 at distance 6, the emitter as its image sees it: form factor by Monte Carlo
  // 0.060.
  EXPECT_NEAR(down / (0.5 * 8 * kPiD), 1 - 0.0603, 0.01);
}

// Two walls that see each other: a white floor gives back its albedo of what falls on it, and no light is
// made.
TEST(VirtualBench, DiffuseSurfacesKeepTheirShare) {
  Scene scene = upward_emitter();
  add_quad(scene, "roof", add_material(scene, "grey", Rgb(0.6f)), Vec3(-500, 3, -500), Vec3(1000, 0, 0),
           Vec3(0, 0, 1000));
  // Of the roof's light some meets the black emitter: less than its form factor over its nearest part.
  const double share = flux_of(trace(LampRig(scene), 1 << 16)) / (8 * kPiD);
  EXPECT_LT(share, 0.6);
  EXPECT_GT(share, 0.6 * 0.85);
}

TEST(VirtualBench, ColourCountsByLuminanceAndLampsByFlux) {
  Scene scene;
  const Id<Material> red = add_material(scene, "red", Rgb(0), Rgb(1, 0, 0)),
                     white = add_material(scene, "white", Rgb(0), Rgb(9));
  for (const auto& [material, x] : {std::pair(red, 0.0f), std::pair(white, 5.0f)})
    add_quad(scene, "quad", material, Vec3(x, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  const auto rays = trace(LampRig(scene));
  EXPECT_NEAR(flux_of(rays), kPiD * (0.2126 + 9), 1e-4);
  double white_rays = 0;
  for (const SourceRay& ray : rays) white_rays += ray.position.x > 4 ? 1 : 0;
  EXPECT_NEAR(white_rays / static_cast<double>(rays.size()), 9 / 9.2126, 1e-3);
}

/// lm through the images of a channel.
double flux_of(const LightField& field, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = 0; i < field.irradiance.size(); ++i)
    sum += static_cast<double>(field.color.at(channel * field.irradiance.size() + i));
  return sum * field.pixel * field.pixel;
}

MeasuredField measured(const std::vector<SourceRay>& rays, NearBasis basis) {
  FieldParams params;
  params.basis = basis;
  params.spacing = 0.1, params.pixels = 16;
  return measure_field([&](const auto& f) { f(rays); }, params, "lamp");
}

// A Lambertian square that faces down sends sin2 60 = 3/4 of pi A L through the filters, in each channel;
// every pixel has its colour.
TEST(VirtualBench, ColouredEmittersMakeFieldsOfTheirColour) {
  Scene scene;
  const Rgb color(30, 20, 5);
  add_quad(scene, "emitter", add_material(scene, "light", Rgb(0), color), Vec3(-0.1f, 0, -0.1f),
           Vec3(0.2f, 0, 0), Vec3(0, 0, 0.2f));
  const auto rays = trace(LampRig(scene), 1 << 18);
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline}) {
    const MeasuredField out = measured(rays, basis);
    ASSERT_FALSE(out.field.is_grey());
    const double sent = 0.75 * kPiD * 0.04;
    std::size_t c = 0;
    for (const float share : {color.r, color.g, color.b}) {
      EXPECT_NEAR(flux_of(out.field, c) / (sent * static_cast<double>(share)), 1, 0.005);
      for (std::size_t i = 0; i < out.field.irradiance.size(); ++i)
        ASSERT_NEAR(out.field.color[c * out.field.irradiance.size() + i],
                    out.field.irradiance[i] * share / luminance(color),
                    1e-5 * std::abs(static_cast<double>(out.field.irradiance[i])) + 1e-6);
      ++c;
    }
    EXPECT_NEAR(flux(out.field), out.kept, 1e-6 * out.kept);
  }
}

// White light from a coloured mirror has the mirror's colour; where all is grey, so is the light field.
TEST(VirtualBench, ReflectorsColourTheLight) {
  const Rgb tints[] = {Rgb(0.9f, 0.5f, 0.2f), Rgb(0.5f)};
  for (const Rgb& tint : tints) {
    Scene scene = upward_emitter();
    const Id<Material> mirror = add_material(scene, "mirror", tint);
    scene.materials[mirror.value].metallic = 1;
    add_quad(scene, "mirror", mirror, Vec3(-50, 3, -50), Vec3(100, 0, 0), Vec3(0, 0, 100));
    const auto rays = trace(LampRig(scene));
    ASSERT_FALSE(rays.empty());
    for (const SourceRay& ray : rays) {
      if (ray.position.z < 1) continue;  // past the mirror
      ASSERT_NEAR(ray.color.r, tint.r / luminance(tint), 1e-5);
      ASSERT_NEAR(ray.color.b, tint.b / luminance(tint), 1e-5);
    }
    FieldParams params;
    params.spacing = 1, params.pixels = 8, params.angle = 45;
    const LightField field = measure_field([&](const auto& f) { f(rays); }, params, "lamp").field;
    EXPECT_EQ(field.is_grey(), tint == Rgb(0.5f));
    if (field.is_grey()) continue;
    EXPECT_NEAR(flux_of(field, 0) / flux_of(field, 1), 0.9 / 0.5, 1e-5);
    EXPECT_NEAR(flux_of(field, 2) / flux_of(field, 1), 0.2 / 0.5, 1e-5);
  }
}

TEST(VirtualBench, SameBitsAtAnyNumberOfThreads) {
  Scene scene = upward_emitter();
  add_quad(scene, "roof", add_material(scene, "grey", Rgb(0.6f)), Vec3(-5, 3, -5), Vec3(10, 0, 0),
           Vec3(0, 0, 10));
  const LampRig rig(scene);
  const auto many = trace(rig, 100000);
  const ThreadLimit one(1);
  const auto single = trace(rig, 100000);
  ASSERT_EQ(many.size(), single.size());
  for (std::size_t i = 0; i < many.size(); ++i) {
    ASSERT_EQ(many[i].position, single[i].position);
    ASSERT_EQ(many[i].flux, single[i].flux);
  }
}

TEST(VirtualBench, BadInput) {
  Scene dark;
  add_quad(dark, "quad", add_material(dark, "grey", Rgb(0.5f)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  EXPECT_THROW(trace(LampRig(dark)), Error);
  Light sun;
  sun.name = "sun";
  sun.intensity = Rgb(1);
  sun.shape = SunLight{};
  dark.lights.push_back(sun);
  EXPECT_THROW(trace(LampRig(dark)), Error);
}

// The sampling plane lies at the lowest start, the grid covers what crosses it within the angle, flux is
// kept.
TEST(MeasureField, PlanesAndFlux) {
  std::vector<SourceRay> rays;
  for (int i = 0; i <= 10; ++i)
    rays.push_back({Vec3(0.01f * static_cast<float>(i), 0, i == 0 ? 0.3f : 0.32f), Vec3(0, 0, -1), 1});
  rays.push_back({Vec3(5, 0, 0.4f), glm::normalize(Vec3(1, 0, -0.1f)), 2});
  FieldParams params;
  params.basis = NearBasis::bell;
  params.spacing = 0.02;
  params.pixels = 8;
  const auto source = [&](const auto& f) { f(rays); };
  const MeasuredField m = measure_field(source, params, "rays");
  EXPECT_NEAR(m.plane, 0.3, 1e-6);
  EXPECT_NEAR(m.kept, 11, 1e-6);
  EXPECT_NEAR(m.lost, 2, 1e-6);
  EXPECT_NEAR(flux(m.field), 11, 1e-4);
  EXPECT_EQ(m.field.columns, 8);
  EXPECT_EQ(m.field.rows, 3);
  EXPECT_DOUBLE_EQ(m.field.distance, 0.5);
  params.lumens = 26;
  EXPECT_NEAR(measure_field(source, params, "rays").kept, 22, 1e-5);
  params.angle = 10;
  params.spacing = 1e-6, params.pixels = 256;
  EXPECT_THROW(measure_field(source, params, "rays"), UsageError);
  rays = {{Vec3(0), Vec3(0, 0, 1), 1}};
  EXPECT_THROW(measure_field(source, params, "rays"), Error);
}

// Colours of single rays may lie outside of Rec. 709, that of the lamp may not: then all of them are less
// saturated, by the same share, and luminance stays.
TEST(MeasureField, ColoursThatFit) {
  std::vector<SourceRay> rays;
  const auto totals = [&] {
    FieldParams params;
    params.basis = NearBasis::bell;
    params.spacing = 0.02;
    params.pixels = 8;
    const LightField field = measure_field([&](const auto& f) { f(rays); }, params, "rays").field;
    Rgb out;
    out.r = static_cast<float>(flux(channel_of(field, 0))),
    out.g = static_cast<float>(flux(channel_of(field, 1)));
    out.b = static_cast<float>(flux(channel_of(field, 2)));
    return out;
  };
  const auto add = [&](const Rgb& color, float lumens) {
    rays.push_back({Vec3(0.01f * static_cast<float>(rays.size()), 0, 0), Vec3(0, 0, -1), lumens, color});
  };
  const Rgb blue(-0.5f, 0.8f, 1 + (1.5f * 0.2126f + 0.2f * 0.7152f) / 0.0722f), amber(3, 0.5061f, 0);
  ASSERT_NEAR(luminance(blue), 1, 1e-5);
  add(blue, 1), add(amber, 3);
  const Rgb both = totals();  // (8.5, 2.32, ...): as they are
  EXPECT_NEAR(both.r, 8.5f, 1e-3f);
  EXPECT_NEAR(both.b, blue.b, 1e-3f);
  rays.clear(), add(blue, 1), add(blue, 1);
  const Rgb alone = totals();  // red: 1 + (-0.5 - 1) s = 0
  EXPECT_NEAR(alone.r, 0, 1e-4f);
  EXPECT_NEAR(alone.g, 2 * (1 - 0.2f / 1.5f), 1e-4f);
  EXPECT_NEAR(luminance(alone), 2, 1e-4f);
}

}  // namespace
}  // namespace sconce
