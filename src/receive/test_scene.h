// SPDX-License-Identifier: Apache-2.0
// What the tests of this folder share.
#pragma once

#include <algorithm>
#include <memory>

#include "receive/atlas.h"
#include "receive/parameterize.h"
#include "scene/shapes.h"

namespace sconce {

/// A scene with everything an atlas needs. Build the scene first, then call finish().
struct TestScene {
  Scene scene;
  World world;
  std::unique_ptr<Tracer> tracer;
  Atlas atlas;

  void look(const Vec3& eye, const Vec3& target, float yfov = 1.2f) {
    const Vec3 z = glm::normalize(eye - target);
    const Vec3 x = glm::normalize(glm::cross(std::abs(z.y) > 0.9f ? Vec3(1, 0, 0) : Vec3(0, 1, 0), z));
    Camera camera;
    camera.frame = Mat4(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(eye, 1));
    camera.yfov = yfov;
    scene.cameras.push_back(camera);
  }
  void finish() {
    world = make_world(scene);
    tracer = std::make_unique<Tracer>(scene, world);
  }
  void unwrap(const AtlasParams& params) { atlas = make_atlas(scene, world, *tracer, params); }
  void unwrap(float density) {
    AtlasParams params;
    params.density = density;
    unwrap(params);
  }
};

inline double flat_area(const std::vector<TexelTriangle>& sides) {
  double sum = 0;
  for (const TexelTriangle& t : sides)
    if (t.page >= 0) sum += static_cast<double>(signed_area(t.uv));
  return sum;
}

/// A cylinder's side (radius, height along y, n facets around), smooth normals, front outwards.
inline Id<Instance> add_cylinder(Scene& scene, Id<Material> material, float radius, float height,
                                 uint32_t n) {
  Mesh mesh;
  mesh.name = "cylinder";
  mesh.material = material;
  for (uint32_t i = 0; i < n; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(n);
    const Vec3 normal(std::cos(a), 0, -std::sin(a));
    for (const float y : {0.0f, height}) {
      mesh.positions.push_back(radius * normal + Vec3(0, y, 0));
      mesh.normals.push_back(normal);
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    mesh.triangles.push_back({{a, b, b + 1}});
    mesh.triangles.push_back({{a, b + 1, a + 1}});
  }
  scene.meshes.push_back(mesh);
  Instance instance;
  instance.name = "cylinder";
  instance.mesh = Id<Mesh>(scene.meshes.size() - 1);
  scene.instances.push_back(instance);
  return Id<Instance>(scene.instances.size() - 1);
}

}  // namespace sconce
