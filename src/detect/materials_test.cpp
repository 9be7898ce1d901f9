// SPDX-License-Identifier: Apache-2.0
// Materials of a renderer that are known, recovered from its pictures; numbers refer to the analytic tests in
// docs/methods.md.
#include "detect/materials.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

Rgb random_rgb(std::mt19937& random, float most) {
  std::uniform_real_distribution<float> u(0, most);
  const float r = u(random), g = u(random);
  return Rgb(r, g, u(random));
}

/// Sixty balls of random materials; every fourth emits, every fifth lets light through.
struct Rig {
  Scene scene;
  World world;
  std::vector<SyntheticMaterial> materials;

  Rig() {
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i) {
      SyntheticMaterial m;
      m.response.reflectance = random_rgb(random, i % 5 == 0 ? 0.5f : 0.97f);
      if (i % 5 == 0) m.response.transmission = random_rgb(random, 0.45f);
      if (i % 4 == 0) m.response.emission = random_rgb(random, 0.3f);
      materials.push_back(m);
      const auto id = add_material(scene, "m" + std::to_string(i), Rgb(0.5f));
      add_sphere(scene, "ball", id, Vec3(3 * (i % 8), 3 * (i / 8), 0), 1, 6, false);
    }
    world = make_world(scene);
  }
  SyntheticHost host(TargetFormat format = TargetFormat::linear) const {
    SyntheticHost h{world, materials};
    h.format = format;
    return h;
  }
};

float worst(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}
/// In codes: what "1/255" of an 8-bit target means.
Rgb encoded(TargetFormat format, const Rgb& v) {
  const auto f = [&](float x) {
    return format == TargetFormat::srgb8 ? linear_to_srgb(x) : std::pow(std::max(x, 0.0f), 0.45f);
  };
  return Rgb(f(v.r), f(v.g), f(v.b));
}

// 31.
TEST(Materials, RecoveredFromFloats) {
  const Rig rig;
  SyntheticHost host = rig.host();
  const Detection found = detect_materials(rig.scene, rig.world, host.renderer());
  for (std::size_t m = 0; m < rig.materials.size(); ++m) {
    const SurfaceResponse &is = rig.materials[m].response, &seen = found.materials[m].response;
    EXPECT_LT(worst(is.emission, seen.emission), 1e-3f) << m;
    EXPECT_LT(worst(is.transmission, seen.transmission), 1e-3f) << m;
    EXPECT_LT(worst(is.reflectance, seen.reflectance), 1e-3f) << m;
    EXPECT_EQ(found.materials[m].faces, 8u);
  }
  EXPECT_TRUE(found.findings.empty()) << found.findings.front();
  EXPECT_EQ(found.cost.draws, host.draws);
  EXPECT_GT(found.cost.milliseconds, 0);
}

TEST(Materials, RecoveredFromCodes) {
  const Rig rig;
  for (const TargetFormat format : {TargetFormat::srgb8, TargetFormat::power8}) {
    SyntheticHost host = rig.host(format);
    const Detection found = detect_materials(rig.scene, rig.world, host.renderer());
    for (std::size_t m = 0; m < rig.materials.size(); ++m) {
      const SurfaceResponse &is = rig.materials[m].response, &seen = found.materials[m].response;
      EXPECT_LT(worst(encoded(format, is.emission), encoded(format, seen.emission)), 1.0f / 255) << m;
      EXPECT_LT(worst(is.transmission, seen.transmission), 1.0f / 255) << m;
      EXPECT_LT(worst(is.reflectance, seen.reflectance), 1.0f / 255) << m;
    }
    EXPECT_TRUE(found.findings.empty()) << found.findings.front();
  }
}

// 31: the seed's transmission forgets to take emission off.
TEST(Materials, TheSeedsTransmissionIsWrongByTheEmission) {
  Scene scene;
  add_quad(scene, "pane", add_material(scene, "glow", Rgb(0.5f)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(0.25f), Rgb(0.3f), Rgb(0.4f)}}}};
  const HostRenderer renderer = host.renderer();
  const TextureSpace space = face_cells(std::vector<uint32_t>{0, 1}, std::vector<int>{4, 4});
  DrawRequest white;
  white.background = 1;
  bool clipped = false;
  const Rgb seed = face_mean(space, 0, capture(renderer, space, white, "white"), clipped);
  EXPECT_NEAR(seed.g, 0.3f + 0.25f, 1e-6f);
  EXPECT_NEAR(detect_materials(scene, world, renderer).materials[0].response.transmission.g, 0.3f, 1e-6f);
}

TEST(Materials, NeverMoreLightThanCame) {
  Scene scene;
  add_quad(scene, "pane", add_material(scene, "toobright", Rgb(0.5f)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(0), Rgb(0.6f), Rgb(0.8f, 0.3f, 1.4f)}}}};
  const SurfaceResponse r = detect_materials(scene, world, host.renderer()).materials[0].response;
  EXPECT_NEAR(r.reflectance.r + r.transmission.r, 0.98f, 1e-5f);
  EXPECT_NEAR(r.reflectance.r / r.transmission.r, 0.8f / 0.6f, 1e-4f);
  EXPECT_NEAR(r.reflectance.g, 0.3f, 1e-5f);
  EXPECT_NEAR(r.reflectance.b + r.transmission.b, 0.98f, 1e-5f);
}

TEST(Materials, ThoseThatShineAreNamed) {
  const Rig rig;
  for (const TargetFormatRow& row : kTargetFormats) {
    SyntheticHost host = rig.host(row.format);
    for (std::size_t m = 0; m < host.materials.size(); m += 3) {
      host.materials[m].specular = 0.15f + 0.01f * static_cast<float>(m % 10);
      host.materials[m].shininess = m % 2 == 0 ? 10 : 60;
    }
    const Detection found = detect_materials(rig.scene, rig.world, host.renderer());
    for (std::size_t m = 0; m < host.materials.size(); ++m)
      EXPECT_EQ(found.materials[m].lambertian, m % 3 != 0)
          << row.name << " " << m << ": " << found.materials[m].residual;
    ASSERT_EQ(found.findings.size(), 20u);
    EXPECT_NE(found.findings[0].find("m0 is not Lambertian: "), std::string::npos) << found.findings[0];
  }
}

// Phong and Blinn lobes from broad to narrow, found again.
TEST(Materials, LobesOnDemand) {
  const Rig rig;
  DetectParams params;
  params.lobes = true;
  for (const TargetFormatRow& row : kTargetFormats) {
    SyntheticHost host = rig.host(row.format);
    for (std::size_t m = 0; m < host.materials.size(); m += 3) {
      host.materials[m].specular = 0.15f + 0.01f * static_cast<float>(m % 10);
      host.materials[m].shininess = std::pow(2.0f, 3 + static_cast<float>(m % 9) / 1.5f);
      host.materials[m].halfway = m % 2 == 0;
    }
    const Detection found = detect_materials(rig.scene, rig.world, host.renderer(), params);
    const bool floats = row.format == TargetFormat::linear;
    for (std::size_t m = 0; m < host.materials.size(); ++m) {
      EXPECT_EQ(found.materials[m].lobe.has_value(), m % 3 == 0)
          << row.name << " " << m << ": " << found.materials[m].residual << " "
          << host.materials[m].shininess;
      if (!found.materials[m].lobe) continue;
      const Lobe& lobe = *found.materials[m].lobe;
      const SyntheticMaterial& is = host.materials[m];
      EXPECT_EQ(lobe.halfway, is.halfway) << row.name << " " << m;
      EXPECT_NEAR(lobe.exponent / is.shininess, 1, floats ? 0.01 : 0.15) << row.name << " " << m;
      EXPECT_LT(worst(lobe.strength, Rgb(is.specular)), floats ? 1e-3f : 0.02f) << row.name << " " << m;
      EXPECT_LT(worst(lobe.diffuse, is.response.reflectance), floats ? 1e-3f : 0.02f) << row.name << " " << m;
      EXPECT_LT(lobe.residual, floats ? 1e-3f : 0.02f) << row.name << " " << m;
    }
    const auto told = std::find_if(found.findings.begin(), found.findings.end(),
                                   [](const std::string& f) { return f.find("m0 is not L") == 0; });
    ASSERT_NE(told, found.findings.end());
    EXPECT_NE(told->find("; a lobe of 0.15, roughness 0.4"), std::string::npos) << *told;
  }
}

TEST(Materials, FacesOnDemand) {
  const Rig rig;
  SyntheticHost host = rig.host();
  host.shift = 2;
  DetectParams params;
  EXPECT_FALSE(detect_materials(rig.scene, rig.world, host.renderer(), params).findings.empty());
  params.per = DetectParams::Per::face;
  const Detection found = detect_materials(rig.scene, rig.world, host.renderer(), params);
  ASSERT_EQ(found.faces.size(), rig.world.size());
  EXPECT_EQ(found.of(rig.world, 100).reflectance, found.faces[100].response.reflectance);
  EXPECT_GT(found.faces[101].response.reflectance.g, found.faces[100].response.reflectance.g + 0.05f);
}

// 31, by texel: each has the reflectance that the renderer has in its middle, and between them it is read.
TEST(Materials, TexelsOnDemand) {
  Scene scene;
  const auto paint = add_material(scene, "painted", Rgb(0.5f));
  add_quad(scene, "wall", paint, Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  add_sphere(scene, "ball", paint, Vec3(0, 0, 4), 1, 4, false);
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(0.1f), Rgb(0.05f), Rgb(0.2f, 0.3f, 0.4f)}}}};
  host.shift = 1;
  DetectParams params;
  params.per = DetectParams::Per::texel;
  params.texel = 0.1f;
  for (const TargetFormatRow& row : kTargetFormats) {
    host.format = row.format;
    const Detection found = detect_materials(scene, world, host.renderer(), params);
    ASSERT_EQ(found.texels.size(), found.space.pixels());
    const float most = row.format == TargetFormat::linear ? 1e-3f : 1.0f / 255;
    std::size_t checked = 0;
    for (std::size_t f = 0; f < found.space.triangles.size(); ++f) {
      const uint32_t t = found.space.triangles[f];
      const auto& [a, b, c] = found.space.corners[f];
      const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
      each_pixel(found.space, f, [&](std::size_t pixel) {
        const Vec2 w = inverse * (pixel_middle(found.space, pixel) - a);
        const Rgb is = Rgb(0.2f, 0.3f, 0.4f) + Rgb(w.x * w.y * static_cast<float>(t % 2));
        EXPECT_LT(worst(found.texels[pixel].reflectance, is), most) << row.name << " " << t;
        EXPECT_LT(worst(found.texels[pixel].transmission, Rgb(0.05f)), most) << row.name << " " << t;
        EXPECT_LT(worst(found.at(world, t, w).reflectance, found.texels[pixel].reflectance), 1e-5f);
        ++checked;
      });
    }
    EXPECT_GT(checked, 400u);
  }
}

TEST(Materials, RenderersThatLookLightsUpByTheScreenAreTold) {
  const Rig rig;
  SyntheticHost host = rig.host();
  host.lamps = {{Vec3(10, 10, 30), Rgb(900)}};
  EXPECT_LT(detect_materials(rig.scene, rig.world, host.renderer()).placement, 1e-5f);
  host.clustered = true;
  const Detection found = detect_materials(rig.scene, rig.world, host.renderer());
  EXPECT_GT(found.placement, 0.5f);
  ASSERT_EQ(found.findings.size(), 1u);
  EXPECT_NE(found.findings[0].find("where it is drawn"), std::string::npos);
}

TEST(Materials, WhatWasNotDrawnIsTold) {
  const Rig rig;
  SyntheticHost host = rig.host();
  host.materials[5].response = {Rgb(), Rgb(1), Rgb()};
  const Detection found = detect_materials(rig.scene, rig.world, host.renderer());
  EXPECT_EQ(found.undrawn, 8u);
  EXPECT_EQ(found.materials[5].faces, 0u);
  ASSERT_EQ(found.findings.size(), 2u);
  EXPECT_EQ(found.findings[0].find("nothing is known of m5: "), 0u);
  EXPECT_EQ(found.findings[1], "8 of 480 faces were not drawn");
}

TEST(Materials, TheSceneTakesThem) {
  const Rig rig;
  SyntheticHost host = rig.host();
  const Scene scene = with_detected(rig.scene, detect_materials(rig.scene, rig.world, host.renderer()));
  EXPECT_LT(worst(scene.materials[7].base_color, rig.materials[7].response.reflectance), 1e-4f);
  EXPECT_EQ(scene.materials[7].name, "m7");
}

/// The message of what detection throws at a renderer.
std::string complaint(const Rig& rig, const HostRenderer& renderer) {
  try {
    detect_materials(rig.scene, rig.world, renderer);
  } catch (const Error& e) {
    return e.what();
  }
  return "no complaint";
}

TEST(Materials, BadRenderersAreToldWhatIsWrong) {
  const Rig rig;
  SyntheticHost host = rig.host();
  using Change = std::function<void(const DrawRequest&, Drawing&)>;
  const auto with = [&](const Change& change) {
    return complaint(rig, {[&host, change](const DrawRequest& request) {
                       Drawing drawing = host.draw(request);
                       change(request, drawing);
                       return drawing;
                     }});
  };
  const auto has = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(with([](const DrawRequest& r, Drawing& d) {
        std::fill(d.values.begin(), d.values.end(), r.background);
      }),
      "drew none of 480 faces");
  has(with([](const DrawRequest&, Drawing& d) { d.values[8] = NAN; }), "has the value nan at pixel (2, 0)");
  has(with([](const DrawRequest&, Drawing& d) { d.values[3] = -1; }), "has the value -1 at pixel (1, 0)");
  has(with([](const DrawRequest&, Drawing& d) { d.width /= 2; }), "pixels (allowed: ");
  has(with([](const DrawRequest&, Drawing& d) { d.values.pop_back(); }), "floats (allowed: ");
  has(with([](const DrawRequest& r, Drawing& d) {
        if (r.background > 0) std::fill(d.values.begin(), d.values.end(), 0.0f);
      }),
      "outside the faces (allowed: the background");
  has(with([](const DrawRequest& r, Drawing& d) {
        if (r.white_card) std::fill(d.values.begin(), d.values.end(), 0.0f);
      }),
      "white card");
  has(with([](const DrawRequest&, Drawing&) { throw std::runtime_error("the context is lost"); }),
      "the renderer's drawing of unlit faces on black: the context is lost");
  has(complaint(rig, {}), "there is no renderer");
}

}  // namespace
}  // namespace sconce
