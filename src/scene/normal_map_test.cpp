// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene/shapes.h"
#include "scene/world.h"

namespace sconce {
namespace {

// 2 * code / 255 - 1: (0.6, 0, 0.8) and (0, 0.6, 0.8) to within half a code.
constexpr unsigned char kSix = 204, kEight = 230, kZero = 128;
constexpr float kCode = 2.0f / 255;

/// A triangle in z = 0 facing +z. Coordinates as given; a map of one texel.
Scene triangle(const std::array<Vec2, 3>& uv, std::array<unsigned char, 3> texel) {
  Scene scene;
  const auto material = add_material(scene, "bumpy", Rgb(0.5f));
  Texture map;
  map.pixels = {1, 1, 3, {texel[0], texel[1], texel[2]}};
  scene.textures = {map};
  scene.materials[0].normal_texture.texture = Id<Texture>(0);
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.texcoords = {{uv[0], uv[1], uv[2]}};
  mesh.triangles = {{{0, 1, 2}}};
  scene.meshes = {mesh};
  Instance instance;
  instance.mesh = Id<Mesh>(0);
  scene.instances = {instance};
  return scene;
}

/// As seen from the front: u to the right, v down.
constexpr std::array<Vec2, 3> kUpright{Vec2(0, 1), Vec2(1, 1), Vec2(0, 0)};

Vec3 mapped(const Scene& scene) {
  const World world = make_world(scene);
  return world.normal(0, Vec2(0.25f)) + normal_offset(scene, world, 0, Vec2(0.25f));
}

void expect_normal(const Scene& scene, const Vec3& expected) {
  const Vec3 n = mapped(scene);
  EXPECT_NEAR(glm::length(n), 1, 1e-6f);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(n[axis], expected[axis], kCode) << axis;
}

TEST(NormalMap, NoMapNoOffset) {
  Scene scene = triangle(kUpright, {kSix, kZero, kEight});
  scene.materials[0].normal_texture = {};
  EXPECT_EQ(normal_offset(scene, make_world(scene), 0, Vec2(0.25f)), Vec3(0));
}

TEST(NormalMap, RightIsAlongUAndUpIsAgainstV) {
  expect_normal(triangle(kUpright, {kZero, kZero, 255}), {0, 0, 1});
  expect_normal(triangle(kUpright, {kSix, kZero, kEight}), {0.6f, 0, 0.8f});
  expect_normal(triangle(kUpright, {kZero, kSix, kEight}), {0, 0.6f, 0.8f});
  const std::array<Vec2, 3> mirrored{Vec2(1, 1), Vec2(0, 1), Vec2(1, 0)},
      turned{Vec2(0, 0), Vec2(0, 1), Vec2(1, 0)};
  expect_normal(triangle(mirrored, {kSix, kZero, kEight}), {-0.6f, 0, 0.8f});
  expect_normal(triangle(mirrored, {kZero, kSix, kEight}), {0, 0.6f, 0.8f});
  expect_normal(triangle(turned, {kSix, kZero, kEight}), {0, 0.6f, 0.8f});
  expect_normal(triangle(turned, {kZero, kSix, kEight}), {-0.6f, 0, 0.8f});
}

TEST(NormalMap, ScaleAndTransform) {
  Scene scene = triangle(kUpright, {kSix, kZero, kEight});
  scene.materials[0].normal_scale = 0;
  expect_normal(scene, {0, 0, 1});
  scene.materials[0].normal_scale = 2;
  expect_normal(scene, glm::normalize(Vec3(1.2f, 0, 0.8f)));
  scene.materials[0].normal_scale = 1;
  scene.materials[0].normal_texture.scale = {-1, 1};
  expect_normal(scene, {-0.6f, 0, 0.8f});
}

TEST(NormalMap, TangentsOfTheMeshDecide) {
  Scene scene = triangle(kUpright, {kSix, kZero, kEight});
  scene.meshes[0].tangents.assign(3, {0, 1, 0, 1});
  expect_normal(scene, {0, 0.6f, 0.8f});
  scene.textures[0].pixels.data = {kZero, kSix, kEight};
  expect_normal(scene, {-0.6f, 0, 0.8f});
  for (glm::vec4& t : scene.meshes[0].tangents) t.w = -1;
  expect_normal(scene, {0.6f, 0, 0.8f});
}

/// The normal moves with its instance, mirrored ones too.
TEST(NormalMap, InstancesCarryTheirFrame) {
  for (const bool given : {false, true}) {
    Scene scene = triangle(kUpright, {kZero, kSix, kEight});
    if (given) scene.meshes[0].tangents.assign(3, {1, 0, 0, 1});
    Mat4& m = scene.instances[0].transform;
    m = Mat4(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(5, 0, 0, 1));
    expect_normal(scene, {0, 0.6f, 0.8f});
    m = Mat4(glm::vec4(0, 0, 2, 0), glm::vec4(0, 2, 0, 0), glm::vec4(-2, 0, 0, 0), glm::vec4(0, 0, 0, 1));
    expect_normal(scene, {-0.8f, 0.6f, 0});
  }
}

}  // namespace
}  // namespace sconce
