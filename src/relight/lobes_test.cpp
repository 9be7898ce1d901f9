// SPDX-License-Identifier: Apache-2.0
// What pixels mirror, by rows over their lobes, against closed forms.
#include <gtest/gtest.h>

#include "core/test_folder.h"
#include "gather/lit_scene.h"
#include "relight/moved_lamps.h"
#include "relight/precompute.h"
#include "scene/lens.h"
#include "scene/shapes.h"
#include "transfer/folded_bounces.h"

namespace sconce {
namespace {

constexpr int kSide = 24;
const Rgb kGold(0.9f, 0.6f, 0.3f);

/// A grey room whose floor is a mirror of some kind, seen from above at a slant.
struct Room : LitScene {
  Camera camera;
  MadeOperators made;

  Room(const Material& floor, TransferMethod method)
      : LitScene(scene_of_it(floor), Grouping::one),
        camera(look_at(Vec3(0.2f, 1.4f, 0.7f), Vec3(0, 0, -0.2f))) {
    TransferParams params;
    params.method = method;
    params.gather = 1024, params.rays = 128, params.cluster = 64, params.lights = 64;
    const TracedScene traced{scene, world, tracer};
    made = make_operators(traced, pixel_receivers(traced, camera, kSide, kSide), params, "scene");
  }
  static Scene scene_of_it(Material floor) {
    Scene scene;
    add_box(scene, "room", add_material(scene, "grey", Rgb(0.5f)), Vec3(-1, 0, -1), Vec3(1, 2, 1), true);
    const auto id = Id<Material>(scene.materials.size());
    floor.name = "floor";
    scene.materials.push_back(floor);
    add_quad(scene, "floor", id, Vec3(-1, 0.01f, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
    return scene;
  }
  /// Of pixel i's lobe.
  SurfacePoint at(std::size_t i) const { return point_of(made.lobes->receivers[i]); }
  float cosine(std::size_t i) const {
    return glm::dot(glm::normalize(Vec3(camera.frame[3]) - at(i).position), at(i).shading_normal);
  }
  /// What all surfaces, sending 1 lm/m2, send to the eye by the lobes, cd/m2, times pi.
  std::vector<Rgb> furnace() const {
    std::vector<Rgbx> light(made.lobes->slots(), Rgbx{1, 1, 1, 0});
    weigh(*made.lobes, light);
    haar_forward(light);
    std::vector<Rgb> out(made.lobes->gather.rows);
    multiply(made.lobes->gather, light, out);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] *= unpack_albedo(made.lobes->receivers[i].albedo);
    return out;
  }
};

Material metal(const Rgb& color, float roughness) {
  Material m;
  m.base_color = color, m.metallic = 1, m.roughness = roughness;
  return m;
}

Rgb schlick(const Rgb& normal, float cosine) {
  return normal + std::pow(1 - cosine, 5.0f) * (Rgb(1) - normal);
}

// 1. In even light a lobe sends on its albedo: all of it for a white metal however rough it is, Schlick's
// share for a smooth one.
TEST(Lobes, FurnaceGivesTheirAlbedo) {
  for (const float roughness : {0.0f, 0.3f, 0.8f}) {
    const Room room(metal(Rgb(1), roughness), TransferMethod::exact);
    ASSERT_TRUE(room.made.lobes);
    EXPECT_GT(room.made.lobes->gather.rows, kSide * kSide / 4u);
    EXPECT_LT(room.made.lobes->gather.rows, room.made.op.gather.rows);
    for (const Rgb& l : room.furnace()) {
      EXPECT_NEAR(l.r, 1, 0.01f) << roughness;
      EXPECT_NEAR(l.b, l.r, 1e-4f);
    }
  }
  Material varnish;
  varnish.base_color = Rgb(0.3f), varnish.metallic = 0, varnish.roughness = 0;
  for (const auto& [floor, normal] : {std::pair(metal(kGold, 0), kGold), std::pair(varnish, Rgb(0.04f))}) {
    const Room room(floor, TransferMethod::exact);
    const std::vector<Rgb> lit = room.furnace();
    for (std::size_t i = 0; i < lit.size(); ++i) {
      const Rgb want = schlick(normal, room.cosine(i));
      EXPECT_NEAR(lit[i].r, want.r, 0.01f * want.r);
      EXPECT_NEAR(lit[i].b, want.b, 0.01f * want.b);
    }
  }
}

TEST(Lobes, FurnaceThroughCompression) {
  const Room room(metal(Rgb(1), 0.3f), TransferMethod::fitted);
  double sum = 0;
  const std::vector<Rgb> lit = room.furnace();
  for (const Rgb& l : lit) sum += static_cast<double>(l.g) / static_cast<double>(lit.size());
  EXPECT_NEAR(sum, 1, 0.03);
}

TEST(Lobes, AFlatMirrorShowsWhatStandsOppositeOfIt) {
  const Room room(metal(Rgb(1), 0), TransferMethod::exact);
  // Only the ceiling shines.
  std::vector<Rgbx> light(room.made.lobes->slots(), Rgbx{});
  for (std::size_t slot = 0; slot < light.size(); ++slot)
    if (room.made.lobes->lit[slot * room.made.lobes->points_per_slot].position[1] > 1.999f)
      light[slot] = {1, 1, 1, 0};
  haar_forward(light);
  std::vector<Rgb> out(room.made.lobes->gather.rows);
  multiply(room.made.lobes->gather, light, out);
  int ceiling = 0, walls = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 eye(room.camera.frame[3]), p = room.at(i).position;
    Vec3 onwards = p - eye;
    onwards.y = -onwards.y;
    const Vec3 end = p + onwards * ((2 - p.y) / onwards.y);  // in the ceiling's plane
    const float inside = 1 - std::max(std::abs(end.x), std::abs(end.z));
    if (std::abs(inside) < 0.15f) continue;  // as coarse as the cloud
    ++(inside > 0 ? ceiling : walls);
    EXPECT_NEAR(out[i].g, inside > 0 ? 1 : 0, 1e-3f) << end.x << " " << end.z;
  }
  EXPECT_GT(ceiling, 20);
  EXPECT_GT(walls, 20);
}

TEST(Lobes, NoneWhereNothingMirrors) {
  Material matt;
  matt.metallic = 0, matt.roughness = 1;
  EXPECT_FALSE(Room(matt, TransferMethod::exact).made.lobes);
}

}  // namespace
}  // namespace sconce
