// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "small_scenes.h"

namespace sconce::test {

/// Waves on all surfaces, by tangents of the mesh or without, mirrored for one material.
inline void add_waves(Scene& scene) {
  constexpr int kSide = 64;
  Texture map;
  map.name = "waves";
  map.pixels = {kSide, kSide, 3, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const float turn = 2 * kPi / kSide;
      const Vec3 n = glm::normalize(Vec3(0.6f * std::sin(turn * static_cast<float>(2 * x)),
                                         0.4f * std::cos(turn * static_cast<float>(x + 3 * y)), 1));
      for (int axis = 0; axis < 3; ++axis)
        map.pixels.data.push_back(static_cast<unsigned char>(std::lround(127.5f * (n[axis] + 1))));
    }
  scene.textures = {map};
  for (Material& material : scene.materials) {
    material.normal_texture.texture = Id<Texture>(0);
    material.normal_texture.scale = {3, 2};
    material.normal_scale = 0.8f;
  }
  scene.materials[1].normal_texture.scale = {-2, 2};
  for (Mesh& mesh : scene.meshes) {
    mesh.texcoords = {{}};
    for (const Vec3& p : mesh.positions) mesh.texcoords[0].emplace_back(p.x + 0.7f * p.z, p.y - 0.4f * p.z);
    if (mesh.name == "back" || mesh.name == "floor") mesh.tangents.assign(4, {0.8f, 0, 0.6f, -1});
  }
}

/// With waves on flat and on smooth surfaces, on both sides of a screen.
inline Scene bumpy_room() {
  Scene scene = two_lamp_room();
  const auto screen = add_material(scene, "screen", Rgb(0.6f, 0.7f, 0.5f), {}, true);
  add_sphere(scene, "ball", Id<Material>(0), Vec3(-0.45f, 0.35f, -0.3f), 0.35f, 8, false);
  add_quad(scene, "screen", screen, Vec3(0.2f, 0, 0.1f), Vec3(0.6f, 0, 0.3f), Vec3(0, 0.9f, 0));
  add_waves(scene);
  return scene;
}

}  // namespace sconce::test
