// SPDX-License-Identifier: Apache-2.0
#include "scene/validate.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/world.h"

namespace sconce {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Two triangles of 1 m, lit by a point light.
Scene small_scene() {
  Scene scene;
  scene.name = "small";
  scene.materials.emplace_back().name = "paint";
  scene.materials[0].base_color = Rgb(0.5f);
  Mesh mesh;
  mesh.name = "square";
  mesh.material = Id<Material>(0u);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  scene.meshes = {mesh};
  scene.instances.emplace_back().mesh = Id<Mesh>(0u);
  scene.lights.emplace_back().intensity = Rgb(1);
  return scene;
}

struct Result {
  std::string warnings;
  Progress progress;
  Result() {
    progress.warning = [this](const std::string& line) { warnings += line + "\n"; };
  }
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;
  bool says(const char* part) const { return warnings.find(part) != std::string::npos; }
};

TEST(Validate, GoodSceneIsSilent) {
  Scene scene = small_scene();
  Result r;
  validate(scene, r.progress);
  EXPECT_EQ(r.warnings, "");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
}

TEST(Validate, IdsInRange) {
  Scene scene = small_scene();
  scene.instances[0].mesh = Id<Mesh>(7u);
  EXPECT_THROW(validate(scene), Error);
  scene = small_scene();
  scene.meshes[0].material = {};
  EXPECT_THROW(validate(scene), Error);
  scene = small_scene();
  scene.materials[0].base_color_texture.texture = Id<Texture>(0u);
  EXPECT_THROW(validate(scene), Error);
  scene = small_scene();
  scene.meshes[0].triangles[0].v[1] = 4;
  EXPECT_THROW(validate(scene), Error);
  scene = small_scene();
  scene.meshes[0].normals.resize(3);
  EXPECT_THROW(validate(scene), Error);
}

TEST(Validate, NonFinitePositionsAreDropped) {
  Scene scene = small_scene();
  scene.meshes[0].positions[3].y = kNaN;
  Result r;
  validate(scene, r.progress);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_TRUE(r.says("1 triangles"));
  scene.meshes[0].positions[0].y = std::numeric_limits<float>::infinity();
  validate(scene);
  EXPECT_TRUE(scene.meshes[0].triangles.empty());
}

TEST(Validate, NoTrianglesIsNoSceneToBakeButOneToLookAt) {
  Scene scene = small_scene();
  scene.instances.clear();
  Result r;
  validate(scene, r.progress);
  EXPECT_FALSE(r.says("metre"));
  EXPECT_THROW(make_world(scene), Error);
}

TEST(Validate, AlbedoScaleTexcoordsAndNumbers) {
  Scene scene = small_scene();
  scene.materials[0].base_color = Rgb(0.97f);
  scene.instances[0].transform = Mat4(0.01f);
  scene.instances[0].transform[3][3] = 1;
  Result r;
  validate(scene, r.progress);
  EXPECT_TRUE(r.says("albedo above 0.95"));
  EXPECT_TRUE(r.says("unit the metre"));

  scene = small_scene();
  scene.textures.emplace_back();
  scene.materials[0].base_color_texture.texture = Id<Texture>(0u);
  scene.materials[0].base_color = Rgb(1.5f, kNaN, -1);
  scene.lights[0].intensity = Rgb(-5);
  Result numbers;
  validate(scene, numbers.progress);
  EXPECT_TRUE(numbers.says("lacks texture coordinates 0"));
  EXPECT_EQ(scene.materials[0].base_color, Rgb(1, 0, 0));
  EXPECT_EQ(scene.lights[0].intensity, Rgb(0));
}

}  // namespace
}  // namespace sconce
