// SPDX-License-Identifier: Apache-2.0
#include "detect/sconce_detect.h"

#include <gtest/gtest.h>

#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

/// A host that speaks C: a furnace box of two materials.
struct CHost {
  Scene scene;
  World world;
  SyntheticHost renderer;
  int fault = 0;

  CHost() : scene(make()), world(make_world(scene)), renderer{world, {}} {
    renderer.materials = {{{Rgb(0.5f), Rgb(), Rgb(0.5f)}}, {{Rgb(0.5f), Rgb(), Rgb(0.5f)}}};
  }
  static Scene make() {
    Scene s;
    add_box(s, "room", add_material(s, "walls", Rgb(0.5f)), Vec3(0), Vec3(1), true);
    add_box(s, "crate", add_material(s, "crate", Rgb(0.5f)), Vec3(0.3f), Vec3(0.5f), false);
    return s;
  }
  static int draw(void* user, const sconce_draw_request* r, void* pixels) {
    auto& self = *static_cast<CHost*>(user);
    if (self.fault != 0) return self.fault;
    DrawRequest request;
    request.lights = static_cast<DrawRequest::Lights>(r->lights);
    request.probe = {Vec3(r->probe_to_light[0], r->probe_to_light[1], r->probe_to_light[2]),
                     r->probe_intensity};
    request.eye = Vec3(r->eye[0], r->eye[1], r->eye[2]);
    request.white_card = r->white_card != 0;
    request.background = r->background;
    request.width = r->width, request.height = r->height;
    request.triangles = {r->faces, r->count};
    request.corners = {reinterpret_cast<const std::array<Vec2, 3>*>(r->corners), r->count};
    const Drawing drawing = self.renderer.draw(request);
    std::copy(drawing.values.begin(), drawing.values.end(), static_cast<float*>(pixels));
    *r->read_milliseconds = 0.25;
    return 0;
  }
};

TEST(DetectInC, Furnace) {
  CHost host;
  std::vector<uint32_t> indices, materials;
  for (std::size_t t = 0; t < host.world.size(); ++t) {
    indices.insert(indices.end(), host.world.triangles[t].v.begin(), host.world.triangles[t].v.end());
    materials.push_back(host.world.materials[t].value);
  }
  sconce_geometry geometry{
      &host.world.positions[0].x, &host.world.normals[0].x, host.world.positions.size(), indices.data(),
      materials.data(),           host.world.size()};
  const sconce_gi_params params{SCONCE_TARGET_LINEAR, 0, 1024, 64, 0, 0.1f, 1, 1};
  char message[256] = "";
  sconce_gi* gi = sconce_gi_create(&geometry, CHost::draw, &host, &params, message, sizeof message);
  ASSERT_NE(gi, nullptr) << message;
  ASSERT_EQ(sconce_gi_material_count(gi), 2u);
  sconce_material material{};
  sconce_gi_material(gi, 1, &material);
  EXPECT_NEAR(material.reflectance[1], 0.5f, 1e-4f);
  EXPECT_EQ(material.lambertian, 1);
  EXPECT_EQ(material.lobe.kind, SCONCE_LOBE_NONE);

  std::vector<float> ambient(3 * host.world.positions.size());
  sconce_frame frame{};
  EXPECT_EQ(sconce_gi_update(gi, ambient.data(), &frame, message, sizeof message), 0);
  for (const float light : ambient) EXPECT_NEAR(light, 1, 0.02f);
  EXPECT_GT(frame.solve_milliseconds, 0);
  EXPECT_EQ(frame.read_milliseconds, 0.25);  // of one drawing

  // Lacquered, its lobe is found again.
  host.renderer.materials[1].specular = 0.3f, host.renderer.materials[1].shininess = 20;
  EXPECT_EQ(sconce_gi_detect(gi, message, sizeof message), 0);
  sconce_gi_material(gi, 1, &material);
  EXPECT_EQ(material.lambertian, 0);
  EXPECT_EQ(material.lobe.kind, SCONCE_LOBE_PHONG);
  EXPECT_NEAR(material.lobe.exponent, 20, 0.2);
  EXPECT_NEAR(material.lobe.strength[1], 0.3f, 1e-3f);
  EXPECT_NEAR(material.lobe.diffuse[1], 0.5f, 1e-3f);
  EXPECT_NEAR(material.lobe.roughness, std::sqrt(2.0f / 82), 1e-3f);
  host.renderer.materials[1].specular = 0;
  EXPECT_EQ(sconce_gi_detect(gi, message, sizeof message), 0);

  // A furnace stays one when its crate moves.
  std::vector<Vec3> places = host.world.positions;
  for (std::size_t v = 24; v < places.size(); ++v) places[v] += Vec3(0.3f, 0, 0.1f);
  EXPECT_EQ(sconce_gi_move(gi, &places[0].x, nullptr, message, sizeof message), 0) << message;
  do {
    EXPECT_EQ(sconce_gi_update(gi, ambient.data(), &frame, message, sizeof message), 0);
    for (const float light : ambient) EXPECT_NEAR(light, 1, 0.03f);
  } while (frame.following != 0);
  places[1] = places[0];
  places[2] = places[0];
  EXPECT_EQ(sconce_gi_move(gi, &places[0].x, nullptr, message, sizeof message), 1);
  EXPECT_NE(std::string(message).find("as many as before: 24"), std::string::npos) << message;

  host.renderer.materials[1].response.reflectance = Rgb(0.2f);
  EXPECT_EQ(sconce_gi_detect(gi, message, sizeof message), 0);
  sconce_gi_material(gi, 1, &material);
  EXPECT_NEAR(material.reflectance[1], 0.2f, 1e-4f);

  host.fault = 7;
  EXPECT_EQ(sconce_gi_update(gi, ambient.data(), nullptr, message, sizeof message), 1);
  EXPECT_STREQ(message, "the renderer's drawing of direct light: the function returned 7 (allowed: 0)");
  for (const float light : ambient) EXPECT_EQ(light, 0);
  EXPECT_EQ(sconce_gi_detect(gi, message, sizeof message), 1);
  sconce_gi_destroy(gi);

  EXPECT_EQ(sconce_gi_create(&geometry, nullptr, &host, &params, message, sizeof message), nullptr);
  EXPECT_STREQ(message, "draw: is no function");
  indices[4] = 999;
  EXPECT_EQ(sconce_gi_create(&geometry, CHost::draw, &host, &params, message, sizeof message), nullptr);
  EXPECT_STREQ(message, "geometry: triangle 1 has vertex 999 (allowed: less than 48)");
}

}  // namespace
}  // namespace sconce
